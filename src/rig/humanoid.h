#pragma once
// The canonical humanoid: 21 joints with the names of VRM 1.0 and glTF humanoids, and the
// proportions of a person of about 1.6 m. Metres, right-handed, Y up, facing +z, +x to its left.

#include <array>
#include <optional>
#include <string_view>

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

}  // namespace panache
