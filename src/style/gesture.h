#pragma once
// Gestures: short characteristic movements of a style, such as a glance over the shoulder. They are
// stored with the style and played on top of it.

#include <array>
#include <string>
#include <vector>

#include "base/result.h"
#include "net/safetensors.h"
#include "rig/humanoid.h"

namespace panache {

// The joints that a gesture turns are the first of the humanoid: hips, torso, head and arms. Legs
// follow the hips by inverse kinematics.
inline constexpr int kGestureJoints = index(HumanJoint::left_upper_leg);

// What a gesture adds at one instant; zero adds nothing.
struct GesturePose {
  // Rotation vectors, heading frame, radians: each joint's turn relative to its parent.
  std::array<Vec3, kGestureJoints> turns{};
  float height = 0;  // Of the hips, metres.
  float lift = 0;    // Of both feet, metres, 0 or more: a hop.

  static constexpr int kSize = 3 * kGestureJoints + 2;  // Numbers when packed, in this order.
};

GesturePose scaled(float weight, GesturePose pose) noexcept;
void add_scaled(float weight, const GesturePose& pose, GesturePose& sum) noexcept;

// A curve of such poses: a uniform cubic B-spline whose value and first two derivatives are zero at
// both ends.
class Gesture {
 public:
  static constexpr float kRate = 15;  // Control points per second.
  static constexpr int kMinPoints = 4, kMaxPoints = 60;

  // `points`: control points, kMinPoints to kMaxPoints.
  explicit Gesture(const std::vector<GesturePose>& points);
  // From the tensor of a file, [points][GesturePose::kSize]; `key` and `name` are for messages.
  static Result<Gesture> read(const Tensor& tensor, const std::string& key,
                              const std::string& name);
  Tensor tensor() const;

  float seconds() const noexcept;
  // `time`: seconds after the start; zero before and after the gesture.
  GesturePose at(float time) const noexcept;
  // Whether it moves hips or feet, so that the feet must be down to start it.
  bool moves_hips() const noexcept { return moves_hips_; }
  // The largest movement and the duration, for display: "head turns left, 1.2 s".
  const std::string& name() const noexcept { return name_; }

 private:
  std::vector<GesturePose> points_;
  bool moves_hips_ = false;
  std::string name_;
};

// The maximum number of gestures of one style.
inline constexpr int kMaxGestures = 16;

}  // namespace panache
