#include "retarget/meeting_hands.h"

#include "base/smooth_step.h"
#include "pose/foot_lock.h"

namespace panache {
namespace {

using enum HumanJoint;

// Lengths of an arm: hands in each other, and hands that have nothing to do with each other.
constexpr float kNear = 0.3f, kFar = 0.6f;

float nearness(float distance) { return smooth_step((kFar - distance) / (kFar - kNear)); }

}  // namespace

void meet_hands(const BodyPose& body, Vec3 between, float arm, HumanPositions& joints,
                BodyChange& change) noexcept {
  const float amount = nearness(length(between));
  if (amount <= 0) return;
  const Vec3 left = joints[index(left_hand)], right = joints[index(right_hand)];
  const Vec3 middle = (left + right) * 0.5f;
  const Vec3 half = lerp(right - left, between * arm, amount) * 0.5f;
  const auto reach = [&](HumanJoint upper, HumanJoint lower, HumanJoint hand, Vec3 target) {
    const Vec3 shoulder = joints[index(upper)], elbow = joints[index(lower)];
    const Vec3 wrist = joints[index(hand)];
    const TwoBoneTurn turn = two_bone_ik(shoulder, elbow, wrist, target,
                                         bend_of(shoulder, elbow, wrist, {0, -1, -0.5f}));
    change.rotations[index(upper)] = normalized(turn.upper * change.rotations[index(upper)]);
    change.rotations[index(lower)] = normalized(turn.lower * change.rotations[index(lower)]);
  };
  reach(left_upper_arm, left_lower_arm, left_hand, middle - half);
  reach(right_upper_arm, right_lower_arm, right_hand, middle + half);
  changed_joints(body, change, joints);
}

}  // namespace panache
