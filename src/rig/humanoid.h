#pragma once
// The canonical humanoid: 21 joints with the names of VRM 1.0 and glTF humanoids, and the
// proportions of a person of about 1.6 m. Metres, right-handed, Y up, facing +z, +x to its left.

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>

#include "base/quat.h"
#include "base/vec.h"

namespace panache {

// Parents before children. The numbers are the order in model files: do not change them.
enum class HumanJoint : int {
  hips,
  spine,
  chest,
  neck,
  head,
  left_shoulder,
  left_upper_arm,
  left_lower_arm,
  left_hand,
  right_shoulder,
  right_upper_arm,
  right_lower_arm,
  right_hand,
  left_upper_leg,
  left_lower_leg,
  left_foot,
  left_toes,
  right_upper_leg,
  right_lower_leg,
  right_foot,
  right_toes,
};
inline constexpr int kHumanJoints = 21;

constexpr int index(HumanJoint joint) { return static_cast<int>(joint); }

// parent[joint]; the hips have -1.
inline constexpr std::array<int, kHumanJoints> kHumanParent = {
    -1, 0, 1, 2, 3, 2, 5, 6, 7, 2, 9, 10, 11, 0, 13, 14, 15, 0, 17, 18, 19};

// The same joint on the other side; central joints map to themselves.
inline constexpr std::array<int, kHumanJoints> kHumanMirror = {
    0, 1, 2, 3, 4, 9, 10, 11, 12, 5, 6, 7, 8, 17, 18, 19, 20, 13, 14, 15, 16};

// "hips", "leftUpperArm", ...: the VRM name.
std::string_view human_joint_name(int joint);
std::optional<int> find_human_joint(std::string_view vrm_name);

// One pose of the canonical body: positions[21] in metres, in world space (Y up) or in the body
// frame, as documented where it is used.
using HumanPositions = std::array<Vec3, kHumanJoints>;

// The same pose with left and right exchanged: its reflection in the plane x = 0.
HumanPositions mirrored(const HumanPositions& positions);

// Proportions of the canonical body, metres.
struct Proportions {
  // Distance from parent; used for the limb joints and the head.
  std::array<float, kHumanJoints> length;
  float leg;                             // Upper plus lower leg.
  float torso;                           // Mid-hip to spine to chest to mid-shoulder.
  float spine_fraction, chest_fraction;  // Positions of spine and chest on the torso, 0 to 1.
  float half_hips, half_shoulders;       // From the middle to a hip joint and to a shoulder joint.
  Vec3 hips_to_mid_hip;                  // In the frame of the hips: x left, y up, z ahead.
  Vec3 mid_shoulder_to_neck;             // In the frame of the chest, likewise.
  Vec3 mid_shoulder_to_left_shoulder, mid_shoulder_to_right_shoulder;  // In the frame of the chest.
  float toe_pitch;  // Downward slope of ankle to toe when standing, radians.
};
extern const Proportions kProportions;

// The pose of a body at one instant, and a change of it.

// The pose of the user's character at one instant, retargeted to the canonical body.
struct BodyPose {
  // World, Y up, metres, canonical proportions, floor at 0.
  HumanPositions positions;
  // World rotations of the user's left and right hand, Y up, in their raw local axes: only their
  // changes are meaningful. A missing hand has the rotation of its nearest mapped ancestor.
  std::array<Quat, 2> hands;
  // World positions of the user's own joints, Y up, metres (own proportions, scaled), above the
  // same floor, with the mid-hip of `positions`. Missing hands and toes are estimated; any other
  // missing joint has the position of its nearest mapped ancestor.
  HumanPositions joints;
  // Heading about +y, radians; 0 faces +z. Not unwrapped.
  float facing = 0;
};

// A BodyPose with more data for retargeting and learning; a step does not need it.
struct RotatedBodyPose : BodyPose {
  // Like `hands`, but for every joint.
  std::array<Quat, kHumanJoints> rotations;
};

// A style's change of one pose.
struct BodyChange {
  // World rotations in the heading frame of the input (origin facing +z), applied on top of each
  // joint's world rotation; the identity leaves the joint alone.
  std::array<Quat, kHumanJoints> rotations;
  float turn = 0;    // Then the whole body turns by this about +y through its hips, radians.
  Vec3 translation;  // And moves by this, world, Y up, canonical metres.
};

// Mean and largest distance of the joints of two bodies in one space, metres.
struct PoseDistance {
  float mean = 0, largest = 0;
};
inline PoseDistance pose_distance(const HumanPositions& a, const HumanPositions& b) noexcept {
  PoseDistance out;
  for (size_t j = 0; j < a.size(); ++j) {
    const float apart = length(a[j] - b[j]);
    out.mean += apart / static_cast<float>(a.size());
    out.largest = std::max(out.largest, apart);
  }
  return out;
}

}  // namespace panache
