#include "style/stages/floor.h"

#include <algorithm>

#include "base/easing.h"
#include "pose/changed_joints.h"
#include "pose/contacts.h"

namespace panache {
namespace {

// A body sinks slowly, so that a hop stays one, but stops sinking quickly. Time constants.
constexpr float kSinkSeconds = 0.8f, kStopSeconds = 0.05f;

// Joints that a lying or kneeling body rests on, and the minimum height of their middle then,
// metres.
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

// How much higher the lowest toe is with `change` than in the input.
float height_of_toes(const BodyPose& body, const HumanPositions& joints, const BodyChange& change) {
  const auto lowest = [](const HumanPositions& of) {
    return std::min(of[index(kToes[0])].y, of[index(kToes[1])].y);
  };
  return mid_hip(body).y + change.translation.y + lowest(joints) - lowest(body.joints);
}

}  // namespace

float FloorClearance::step(const BodyPose& body, const HumanPositions& joints, float amount,
                           float carried, float ground, const StepTime& time,
                           const BodyChange& change) noexcept {
  const float depth =
      std::max(floor_depth(body, joints, change), resting_depth(body, joints, change));
  const float height = carried * std::max(0.0f, height_of_toes(body, joints, change) - ground);
  const float seconds = height > sink_ ? kSinkSeconds : kStopSeconds;
  approach(sink_, height, time.gain(seconds), 1e-5f);
  return amount * (depth - sink_);
}

}  // namespace panache
