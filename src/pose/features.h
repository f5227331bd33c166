#pragma once
// The networks' input: the features of one instant, and the window of instants.

#include <array>
#include <span>

#include "pose/root_pose.h"

namespace panache {

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

}  // namespace panache
