#include "style/stages/add_gesture.h"

#include "base/smooth_step.h"
#include "pose/limb.h"

namespace panache {
namespace {

constexpr float kLifted = 0.03f;  // Metres: a foot that is lifted by this is free.
constexpr float kFirm = 0.05f;    // See bend_of(), metres.

float legs_of(const Shape& shape) { return shape.regions[static_cast<size_t>(Region::legs)]; }

}  // namespace

void add_gesture(const GesturePose& gesture, const Shape& shape, const BodyPose& body,
                 BodyChange& change) noexcept {
  HumanPositions before, joints;
  changed_joints(body, change, before);
  // Rotations add up from the hips to the hands.
  std::array<Quat, kGestureJoints> turns;
  for (int j = 0; j < kGestureJoints; ++j) {
    const float weight = shape.regions[static_cast<size_t>(region_of(j))];
    const Quat own = exp_rotation(gesture.turns[static_cast<size_t>(j)] * weight);
    turns[j] = kHumanParent[j] < 0 ? own : normalized(turns[kHumanParent[j]] * own);
    change.rotations[j] = normalized(turns[j] * change.rotations[j]);
  }
  const float height = gesture.height * legs_of(shape), lift = gesture.lift * legs_of(shape);
  change.translation.y += height;
  if (height == 0 && lift == 0 && gesture.turns[0] == Vec3{}) return;
  changed_joints(body, change, joints);
  for (size_t f = 0; f < kFeet; ++f) {
    const LimbJoints leg = leg_joints(static_cast<int>(f));
    // Seen from the hips.
    const Vec3 target = before[leg.end] + Vec3{0, lift - height, 0};
    const Vec3 ahead = knee_way(before[leg.end], before[index(kToes[f])]);
    turn_limb(leg, target,
              bend_of(before[leg.root], before[leg.middle], before[leg.end], ahead, kFirm), joints,
              change);
  }
}

float share_lifted(const GesturePose& gesture, const Shape& shape) noexcept {
  return smooth_step(gesture.lift * legs_of(shape) / kLifted);
}

}  // namespace panache
