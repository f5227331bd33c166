#include "style/stages/energy.h"

#include <algorithm>
#include <cmath>

#include "base/elementary.h"

namespace panache {
namespace {

using enum HumanJoint;

// Long enough for the mean of a walk to hold still, short enough to follow into another posture.
constexpr float kMeanSeconds = 1.5f;
// Added movement approaches this, so that a punch does not become a windmill. Radians.
constexpr float kMaxAdded = 0.6f;
// A direction opposite to its mean has no shortest way there. Radians.
constexpr float kFar = 2, kOpposite = 2.9f;

// A limb goes from its joint to the end.
struct Limb {
  HumanJoint joint, end;
};
constexpr std::array<Limb, 5> kParts = {{{neck, head},
                                         {left_upper_arm, left_lower_arm},
                                         {left_lower_arm, left_hand},
                                         {right_upper_arm, right_lower_arm},
                                         {right_lower_arm, right_hand}}};

// The chest in the heading frame: x along the shoulders, y along the spine.
Quat chest_of(const HeadingBody& body) {
  const auto& offsets = body.offsets;
  const Vec3 up = normalized(offsets[index(chest)] + offsets[index(neck)], {0, 1, 0});
  const Vec3 across = offsets[index(left_shoulder)] + offsets[index(left_upper_arm)] -
                      offsets[index(right_shoulder)] - offsets[index(right_upper_arm)];
  const Vec3 ahead = normalized(cross(across, up), {0, 0, 1});
  return from_axes(cross(up, ahead), up, ahead);
}

// What to add to the turn `from_mean` of a part.
Quat added_turn(Vec3 from_mean, float amount) {
  const float angle = length(from_mean);
  float added = amount * (1 - smooth_step((angle - kFar) / (kOpposite - kFar)));
  if (added > 0) added /= 1 + added * angle / kMaxAdded;
  return exp_rotation(from_mean * added);
}

}  // namespace

void Energy::step(const HeadingBody& body, float energy, float share, const StepTime& time,
                  BodyChange& change) noexcept {
  if (energy == 1) {
    runs_ = false;
    return;
  }
  // Starts without effect: the mean is where the body is.
  const float gain = runs_ ? time.gain(kMeanSeconds) : 1.0f;
  runs_ = true;
  const float amount = (energy - 1) * share;
  const auto add = [&](HumanJoint joint, Quat turn) {
    Quat& rotation = change.rotations[index(joint)];
    rotation = normalized(rotation * turn);
  };

  const Quat now = chest_of(body);
  chest_ = nlerp(chest_, now, gain);
  const Vec3 from_mean = log_rotation(now * conjugate(chest_));
  const Quat turn = added_turn(from_mean, amount);
  add(spine, added_turn(from_mean, amount / 2));
  for (const HumanJoint joint : {chest, left_shoulder, right_shoulder}) add(joint, turn);

  for (size_t l = 0; l < kLimbs; ++l) {
    const auto [joint, end] = kParts[l];
    const Vec3 direction = normalized(body.offsets[index(end)], {0, -1, 0});
    limbs_[l] += (direction - limbs_[l]) * gain;
    const Vec3 mean = normalized(limbs_[l], direction);
    const Quat limb = added_turn(log_rotation(rotation_between(mean, direction)), amount);
    add(joint, limb);
    if (end == head || end == left_hand || end == right_hand) add(end, limb);
  }
}

}  // namespace panache
