#pragma once
// What the networks see of one instant, and the window of instants that they see at once.

#include <array>
#include <span>

#include "pose/root_pose.h"

namespace panache {

inline constexpr int kWindowPoses = 6;          // The current pose and the five before it,
inline constexpr double kWindowSpacing = 0.05;  // this many seconds apart.
inline constexpr int kRootNumbers = 3;          // See RootNumber.
inline constexpr int kMaxPoseNumbers = 130;     // Of the larger layout, root numbers included.

// The root numbers in their order: velocity over the ground, m/s, and turn rate, rad/s.
enum RootNumber { kVelocityLeft, kVelocityForward, kTurnRate };

// How a pose is laid out in numbers. Root numbers come last in both.
enum class PoseLayout {
  // 21 joint positions in the body frame, metres [63]; then the root numbers.
  positions,
  // See AbsolutePose: 21 rotations of six numbers each [126]; height of the hips, metres; then the
  // root numbers.
  rotations,
};
constexpr int pose_numbers(PoseLayout layout) { return layout == PoseLayout::positions ? 66 : 130; }
// Where the root numbers begin.
constexpr int root_offset(PoseLayout layout) { return pose_numbers(layout) - kRootNumbers; }

// Writes the pose_numbers(layout) - kRootNumbers first numbers of a pose given in the body frame.
void write_pose_numbers(PoseLayout layout, const HumanPositions& body,
                        std::span<float> out) noexcept;
// Writes the root numbers of a body that went from `before` to `now` in `seconds` > 0.
void write_root_numbers(const Ground& before, const Ground& now, double seconds,
                        std::span<float, kRootNumbers> out) noexcept;
// The reverse of the two: the body that these numbers of layout positions are, and where a body
// comes to stand that moves from `before` with these root numbers for `seconds`.
HumanPositions read_positions(std::span<const float> pose) noexcept;
Ground move_ground(const Ground& before, std::span<const float, kRootNumbers> root,
                   double seconds) noexcept;

}  // namespace panache
