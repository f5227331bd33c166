#include "style/stages/add_gesture.h"

#include <algorithm>

#include "base/easing.h"
#include "pose/changed_joints.h"
#include "pose/limb.h"
#include "pose/two_bone.h"

namespace panache {
namespace {

constexpr float kLifted = 0.03f;     // Metres: a foot that is lifted by this is free.
constexpr float kFirmKnee = 0.05f;   // See bend_of(), metres.
constexpr float kLegReach = 0.985f;  // Maximum stretch, as a share of the leg's length.
constexpr float kSoftLimit = 0.02f;  // Metres over which the limit sets in.

float legs_of(const Shape& shape) { return shape.regions[static_cast<size_t>(Region::legs)]; }

// How far the hips must sink so that no leg stretches beyond kLegReach, or beyond its stretch
// without the gesture; softly. `before` and `joints`: without and with the gesture.
float drop_for_legs(const HumanPositions& before, const HumanPositions& joints, float raised) {
  float drop = 0;
  for (size_t f = 0; f < kFeet; ++f) {
    const LimbJoints leg = leg_joints(static_cast<int>(f));
    const float whole = length(before[leg.middle] - before[leg.root]) +
                        length(before[leg.end] - before[leg.middle]);
    const float longest = std::max(kLegReach * whole, length(before[leg.end] - before[leg.root]));
    const Vec3 way = before[leg.end] - Vec3{0, raised, 0} - joints[leg.root];
    const float over = length(way) - longest;
    if (over > 0) drop = std::max(drop, over * over / (over + kSoftLimit));
  }
  return drop;
}

}  // namespace

void add_gesture(const GesturePose& gesture, const Shape& shape, const HeadingBody& body,
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
  const float lift = gesture_lift(gesture, shape);
  float height = gesture.height * legs_of(shape);
  if (height == 0 && lift == 0 && gesture.turns[0] == Vec3{}) return;
  changed_joints(body, change, joints);
  height -= drop_for_legs(before, joints, height - lift);
  change.translation.y += height;
  for (size_t f = 0; f < kFeet; ++f) {
    const LimbJoints leg = leg_joints(static_cast<int>(f));
    // Relative to the hips.
    const Vec3 target = before[leg.end] + Vec3{0, lift - height, 0};
    const Vec3 ahead = knee_way(before[leg.end], before[index(kToes[f])]);
    turn_limb(leg, target,
              bend_of(before[leg.root], before[leg.middle], before[leg.end], ahead, kFirmKnee),
              joints, change);
  }
}

float gesture_lift(const GesturePose& gesture, const Shape& shape) noexcept {
  return gesture.lift * legs_of(shape);
}

float share_lifted(float lift) noexcept { return smooth_step(lift / kLifted); }

}  // namespace panache
