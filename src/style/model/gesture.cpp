#include "style/model/gesture.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <span>

namespace panache {
namespace {

// The numbers of a pose in the order of a file.
template <class Visit>
void for_each_number(GesturePose& pose, Visit&& visit) {
  for (Vec3& turn : pose.turns) visit(turn.x), visit(turn.y), visit(turn.z);
  visit(pose.height), visit(pose.lift);
}

GesturePose unpack_pose(std::span<const float> numbers) {
  GesturePose pose;
  size_t next = 0;
  for_each_number(pose, [&](float& number) { number = numbers[next++]; });
  return pose;
}

// "1.2 s", without the program's locale.
std::string seconds_text(float seconds) {
  const int tenths = static_cast<int>(std::lround(seconds * 10));
  return std::to_string(tenths / 10) + "." + std::to_string(tenths % 10) + " s";
}

}  // namespace

GesturePose scaled(float weight, GesturePose pose) noexcept {
  for (Vec3& turn : pose.turns) turn = turn * weight;
  pose.height *= weight;
  pose.lift *= weight;
  return pose;
}

GesturePose mirrored(const GesturePose& pose) noexcept {
  GesturePose out = pose;
  for (size_t j = 0; j < kGestureJoints; ++j) {
    const Vec3 turn = pose.turns[static_cast<size_t>(kHumanMirror[j])];
    out.turns[j] = {turn.x, -turn.y, -turn.z};
  }
  return out;
}

void add_scaled(float weight, const GesturePose& pose, GesturePose& sum) noexcept {
  for (size_t j = 0; j < kGestureJoints; ++j) sum.turns[j] += pose.turns[j] * weight;
  sum.height += pose.height * weight;
  sum.lift += pose.lift * weight;
}

Gesture::Gesture(const std::vector<GesturePose>& points) : points_(points) {
  assert(points.size() >= kMinPoints && points.size() <= kMaxPoints);
  moves_hips_ = std::ranges::any_of(points, [](const GesturePose& pose) {
    return pose.height != 0 || pose.lift != 0 || length(pose.turns[0]) != 0;
  });
  name_gestures({this, 1});
}

void name_gestures(std::span<Gesture> gestures) {
  std::vector<std::vector<std::string>> movements;
  for (const Gesture& gesture : gestures) movements.push_back(movements_of(gesture.points_));
  const std::vector<std::string> names = distinct_names(movements);
  for (size_t g = 0; g < gestures.size(); ++g) {
    gestures[g].name_ = names[g] + ", " + seconds_text(gestures[g].seconds());
  }
}

Result<float> read_gesture_rate(std::string_view text) {
  double number = 0, unit = 1;
  bool good = text.size() <= 8, after_point = false;
  for (const char c : text) {
    if (c == '.' && !after_point) {
      after_point = true;
      continue;
    }
    good = good && c >= '0' && c <= '9';
    number = 10 * number + (c - '0');
    if (after_point) unit *= 10;
  }
  const auto rate = static_cast<float>(number / unit);
  if (good && rate <= kMaxGestureRate) return rate;
  return Error{"'" + std::string(text) +
               "'; expected gestures a second from 0 to 10, such as 0.25"};
}

Result<Gesture> Gesture::read(const Tensor& tensor, const std::string& key,
                              const std::string& name) {
  const std::vector<int64_t>& shape = tensor.shape;
  if (shape.size() != 2 || shape[1] != GesturePose::kSize || shape[0] < kMinPoints ||
      shape[0] > kMaxPoints) {
    return Error{name + ": tensor '" + key + "' is no gesture; expected " +
                 std::to_string(kMinPoints) + " to " + std::to_string(kMaxPoints) + " rows of " +
                 std::to_string(GesturePose::kSize) + " numbers"};
  }
  // Impossible movements would only be limited later.
  constexpr float kMax = 10;
  if (!std::ranges::all_of(tensor.values, [](float v) { return std::abs(v) <= kMax; })) {
    return Error{name + ": tensor '" + key + "' holds a number beyond 10 radians or metres"};
  }
  std::vector<GesturePose> points(static_cast<size_t>(shape[0]));
  for (size_t i = 0; i < points.size(); ++i) {
    points[i] = unpack_pose(std::span(tensor.values).subspan(i * GesturePose::kSize));
  }
  return Gesture(points);
}

Tensor Gesture::tensor() const {
  Tensor out;
  out.shape = {static_cast<int64_t>(points_.size()), GesturePose::kSize};
  out.half = true;
  for (GesturePose pose : points_) {
    for_each_number(pose, [&](float number) { out.values.push_back(from_half(to_half(number))); });
  }
  return out;
}

float Gesture::seconds() const noexcept { return static_cast<float>(points_.size() + 3) / kRate; }

GesturePose Gesture::at(float time) const noexcept {
  GesturePose out;
  if (!(time > 0 && time < seconds())) return out;
  const float knot = time * kRate;
  const int last = static_cast<int>(knot);
  const float x = knot - static_cast<float>(last), y = 1 - x;
  const std::array<float, 4> weights = {y * y * y / 6, (4 - 6 * x * x + 3 * x * x * x) / 6,
                                        (4 - 6 * y * y + 3 * y * y * y) / 6, x * x * x / 6};
  for (int i = 0; i < 4; ++i) {
    const int point = last - 3 + i;
    if (point < 0 || point >= static_cast<int>(points_.size())) continue;
    add_scaled(weights[i], points_[static_cast<size_t>(point)], out);
  }
  return out;
}

}  // namespace panache
