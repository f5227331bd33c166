#include "pose/changed_joints.h"

#include <algorithm>

namespace panache {
namespace {

void put_joints(int first, const HeadingBody& body, const BodyChange& change,
                HumanPositions& out) noexcept {
  for (int j = first; j < kHumanJoints; ++j) {
    const int parent = kHumanParent[j];
    out[j] = out[parent] + rotate(change.rotations[parent], body.offsets[j]);
  }
}

}  // namespace

Vec3 mid_hip(const BodyPose& body) noexcept {
  return (body.joints[index(HumanJoint::left_upper_leg)] +
          body.joints[index(HumanJoint::right_upper_leg)]) *
         0.5f;
}

HeadingBody::HeadingBody(const BodyPose& body) noexcept
    : BodyPose(body), to_heading(rotation_y(-body.facing)) {
  offsets[0] = rotate(to_heading, joints[0] - mid_hip(body));
  for (int j = 1; j < kHumanJoints; ++j) {
    offsets[j] = rotate(to_heading, joints[j] - joints[kHumanParent[j]]);
  }
}

void changed_joints(const HeadingBody& body, const BodyChange& change,
                    HumanPositions& out) noexcept {
  // The hips turn about the middle of the hip joints, as in Rig::write.
  out[0] = rotate(change.rotations[0], body.offsets[0]);
  put_joints(1, body, change, out);
}

void changed_legs(const HeadingBody& body, const BodyChange& change, HumanPositions& out) noexcept {
  put_joints(index(HumanJoint::left_upper_leg), body, change, out);
}

float toe_floor(const BodyPose& body) noexcept {
  float floor = 0;
  for (const HumanJoint toe : kToes) floor = std::min(floor, body.joints[index(toe)].y);
  return floor;
}

float floor_depth(const BodyPose& body, const HumanPositions& joints,
                  const BodyChange& change) noexcept {
  const float lowest = std::min(joints[index(kToes[0])].y, joints[index(kToes[1])].y);
  return std::max(0.0f, toe_floor(body) - (mid_hip(body).y + change.translation.y + lowest));
}

}  // namespace panache
