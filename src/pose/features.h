#pragma once
// The networks' input: the features of one instant, their mirror image, the window of instants, and
// a whole pose of the canonical skeleton packed as features.

#include <array>
#include <span>

#include "base/quat.h"
#include "rig/humanoid.h"

namespace panache {

// Position and heading of a body on the ground, and the body frame there.

// Position and heading on the ground plane.
struct RootPose {
  Vec3 position;     // Under the hips, y = 0; world, metres.
  float facing = 0;  // About +y, radians, unwrapped: it never jumps by a full turn.
};

// The root pose of `body`, with the facing nearest to `last_facing` (radians).
RootPose root_pose_of(const BodyPose& body, float last_facing) noexcept;

// The equivalent of `angle` (radians) nearest to `reference`.
float unwrap_angle(float angle, float reference) noexcept;

// From `a` (t = 0) to `b` (t = 1), linearly.
RootPose interpolate(const RootPose& a, const RootPose& b, float t) noexcept;

// `world` (Y up, metres) in the body frame: relative to the ground point under the hips, facing +z.
void to_body_frame(const HumanPositions& world, const RootPose& root,
                   HumanPositions& body) noexcept;
// The inverse.
HumanPositions to_world(const HumanPositions& body, const RootPose& root) noexcept;
Vec3 to_world(Vec3 point, const RootPose& root) noexcept;

inline constexpr int kWindowPoses = 6;          // The current pose and the five before it,
inline constexpr double kWindowSpacing = 0.05;  // this many seconds apart.
inline constexpr int kRootFeatures = 3;         // See RootNumber.

// The root features in their order: velocity over the ground, m/s, and turn rate, rad/s.
enum RootNumber { kVelocityLeft, kVelocityForward, kTurnRate };

// The layout of a pose's features. Root features come last in both.
enum class PoseLayout {
  // 21 joint positions in the body frame, metres [63]; then the root features.
  positions,
  // See AbsolutePose: 21 rotations of six numbers each [126]; height of the hips, metres; then the
  // root features.
  rotations,
};
constexpr int pose_feature_count(PoseLayout layout) {
  return layout == PoseLayout::positions ? 66 : 130;
}
// Where the root features begin.
constexpr int root_offset(PoseLayout layout) { return pose_feature_count(layout) - kRootFeatures; }

// Writes the first pose_feature_count(layout) - kRootFeatures features of a pose in the body frame.
void write_pose_features(PoseLayout layout, const HumanPositions& body,
                         std::span<float> out) noexcept;
// Writes the root features of a body that went from `before` to `now` in `seconds` > 0.
void write_root_features(const RootPose& before, const RootPose& now, double seconds,
                         std::span<float, kRootFeatures> out) noexcept;
// The inverse of both: the body with these features of layout positions, and the root after moving
// from `before` with these root features for `seconds`.
HumanPositions read_positions(std::span<const float> pose) noexcept;
RootPose move_root(const RootPose& before, std::span<const float, kRootFeatures> root,
                   double seconds) noexcept;

// Mirrors a pose's features, left for right, in place. numbers[pose_feature_count(layout)]
void mirror_pose(PoseLayout layout, std::span<float> numbers) noexcept;
// The same for any number of consecutive poses.
void mirror_poses(PoseLayout layout, std::span<float> numbers) noexcept;

// A whole pose of the canonical skeleton, packed in PoseLayout::rotations.
struct AbsolutePose {
  // The hips' in the body frame, all others relative to the parent. Packed as the first two columns
  // of the matrix.
  std::array<Quat, kHumanJoints> rotations;
  float hips_height = 0;                    // Metres.
  std::array<float, kRootFeatures> root{};  // See RootNumber.

  static constexpr int kSize = pose_feature_count(PoseLayout::rotations);  // Numbers when packed.
};

// Packs the fields in the order above.
void pack(const AbsolutePose& pose, std::span<float, AbsolutePose::kSize> out) noexcept;
// Columns need not be orthonormal: outputs of networks are only nearly so.
AbsolutePose unpack_pose(std::span<const float, AbsolutePose::kSize> numbers) noexcept;

// Converts rotations from a common frame to the parents' frames.
std::array<Quat, kHumanJoints> to_local(const std::array<Quat, kHumanJoints>& frames) noexcept;
// Writes six numbers per rotation and returns the end. out[6 * kHumanJoints]
float* write_rotations(const std::array<Quat, kHumanJoints>& rotations, float* out) noexcept;

}  // namespace panache
