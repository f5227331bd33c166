#pragma once
// Gestures: short characteristic movements of a style, such as a glance over the shoulder. They are
// stored with the style and played on top of it.

#include <array>
#include <span>
#include <string>
#include <string_view>
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
// Left for right.
GesturePose mirrored(const GesturePose& pose) noexcept;
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
  // What it does and how long, for display: "glances left, 1.2 s".
  const std::string& name() const noexcept { return name_; }

 private:
  friend void name_gestures(std::span<Gesture> gestures);

  std::vector<GesturePose> points_;
  bool moves_hips_ = false;
  std::string name_;
};

// Names all gestures of a style, so that no two have the same name; see distinct_names().
void name_gestures(std::span<Gesture> gestures);

// How many gestures a second a text says, "0.25"; an empty one says 0.
Result<float> read_gesture_rate(std::string_view text);

// The maximum number of gestures of one style, and of gestures per second.
inline constexpr int kMaxGestures = 16;
inline constexpr float kMaxGestureRate = 10;

// gesture_name.cpp: what a gesture does, in words.

// The movements of a gesture with these control points, the largest first: "glances over the left
// shoulder", "throws both arms up". At least one; small ones are left out.
std::vector<std::string> movements_of(const std::vector<GesturePose>& points);

// A name for each of a style's gestures, given their movements: the largest movement, and more of
// them where names would be equal. Gestures with the same movements are numbered.
std::vector<std::string> distinct_names(std::span<const std::vector<std::string>> gestures);

}  // namespace panache
