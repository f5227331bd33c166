#include "style/stages/floor.h"

#include "pose/changed_joints.h"

#include <algorithm>

namespace panache {
namespace {

constexpr float kLiftSeconds = 0.1f;  // Time constant.

// What a body rests on that does not stand, and how high the middle of these joints then is at
// least, metres.
struct Rest {
  HumanJoint joint;
  float height;
};
constexpr Rest kRests[] = {{HumanJoint::left_lower_leg, 0.05f},
                           {HumanJoint::right_lower_leg, 0.05f},
                           {HumanJoint::hips, 0.08f}};

// How much deeper a knee or the hips are with `change` than both that height and the input's own.
float resting_depth(const BodyPose& body, const HumanPositions& joints, const BodyChange& change) {
  const float origin = mid_hip(body).y + change.translation.y;
  float depth = 0;
  for (const Rest& rest : kRests) {
    const float lowest = std::min(rest.height, body.joints[index(rest.joint)].y);
    depth = std::max(depth, lowest - (origin + joints[index(rest.joint)].y));
  }
  return depth;
}

}  // namespace

void FloorClearance::step(const BodyPose& body, const HumanPositions& joints, float amount,
                          const StepTime& time, BodyChange& change) noexcept {
  const float depth =
      std::max(floor_depth(body, joints, change), resting_depth(body, joints, change));
  lift_ += time.gain(kLiftSeconds) * (depth - lift_);
  change.translation.y += amount * lift_;
}

}  // namespace panache
