#include "style/stages/steady_arms.h"

#include "pose/limb.h"

namespace panache {
namespace {

// Radians/s. With 5, a few more joints jump where an elbow arrives late; with 8, elbows jump a
// quarter more often; with 4, hands miss each other by more.
constexpr float kRate = 6;

constexpr std::array<HumanJoint, 6> kArmJoints = {kUpperArms[0], kLowerArms[0], kHands[0],
                                                  kUpperArms[1], kLowerArms[1], kHands[1]};

}  // namespace

ArmRotations arm_rotations(const BodyChange& change) noexcept {
  ArmRotations rotations;
  for (size_t i = 0; i < rotations.size(); ++i) {
    rotations[i] = change.rotations[index(kArmJoints[i])];
  }
  return rotations;
}

void SteadyArms::step(const ArmRotations& before, const StepTime& time,
                      BodyChange& change) noexcept {
  const float max = kRate * time.output;
  for (size_t i = 0; i < before.size(); ++i) {
    Quat &now = change.rotations[index(kArmJoints[i])], &last = corrections_[i];
    const Quat wanted = now == before[i] ? Quat{} : normalized(now * conjugate(before[i]));
    const Vec3 turn = wanted == last ? Vec3{} : log_rotation(wanted * conjugate(last));
    const float far = length(turn);
    if (time.first || far <= max) {
      last = wanted;
      continue;
    }
    last = normalized(exp_rotation(turn * (max / far)) * last);
    now = normalized(last * before[i]);
  }
}

}  // namespace panache
