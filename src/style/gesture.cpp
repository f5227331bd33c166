#include "style/gesture.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <span>

#include "base/quat.h"

namespace panache {
namespace {

// The numbers of a pose in the order of a file.
template <class Visit>
void for_each_number(GesturePose& pose, Visit&& visit) {
  for (Vec3& turn : pose.turns) visit(turn.x), visit(turn.y), visit(turn.z);
  visit(pose.height), visit(pose.lift);
}

GesturePose unpack(std::span<const float> numbers) {
  GesturePose pose;
  size_t next = 0;
  for_each_number(pose, [&](float& number) { number = numbers[next++]; });
  return pose;
}

// The turn of `joint` relative to `parent` (an ancestor, or -1), a rotation vector.
Vec3 turn_beyond(const GesturePose& pose, int parent, int joint) {
  Quat turn;
  for (int j = joint; j != parent; j = kHumanParent[j]) turn = exp_rotation(pose.turns[j]) * turn;
  return log_rotation(turn);
}

struct Moved {
  const char* part;
  Vec3 turn = {};  // At its largest.
  float size = 0;  // In units of a noticeable turn.
};

// The direction of a turn of torso or head.
const char* direction_of(Vec3 turn, bool is_head) {
  const float x = std::abs(turn.x), y = std::abs(turn.y), z = std::abs(turn.z);
  if (y >= x && y >= z) return turn.y > 0 ? "turns left" : "turns right";
  if (x >= z && is_head) return turn.x > 0 ? "nods" : "looks up";
  if (x >= z) return turn.x > 0 ? "bends forward" : "bends back";
  return turn.z > 0 ? "leans right" : "leans left";
}

// The largest turn of each part, in units of a noticeable one.
struct Moves {
  Moved head{"head"}, body{"body"}, left{"left arm"}, right{"right arm"};
  float lift = 0, low = 0;  // Metres.
};

Moves moves_of(const std::vector<GesturePose>& points) {
  using enum HumanJoint;
  constexpr float kNoticed = 0.25f, kNoticedArm = 0.6f;  // Radians.
  Moves moves;
  for (const GesturePose& pose : points) {
    const auto see = [&](Moved& moved, int parent, HumanJoint joint, float noticed) {
      const Vec3 turn = turn_beyond(pose, parent, index(joint));
      if (length(turn) / noticed > moved.size) moved = {moved.part, turn, length(turn) / noticed};
    };
    see(moves.head, index(chest), head, kNoticed);
    see(moves.body, -1, chest, kNoticed);
    for (const HumanJoint joint : {left_upper_arm, left_hand}) {
      see(moves.left, index(chest), joint, kNoticedArm);
    }
    for (const HumanJoint joint : {right_upper_arm, right_hand}) {
      see(moves.right, index(chest), joint, kNoticedArm);
    }
    moves.lift = std::max(moves.lift, pose.lift);
    moves.low = std::min(moves.low, pose.height);
  }
  return moves;
}

std::string describe(const std::vector<GesturePose>& points) {
  constexpr float kNoticedHeight = 0.06f;  // Metres.
  const auto [head, body, left, right, lift, low] = moves_of(points);
  if (lift > kNoticedHeight) return "hop";
  const float arms = std::max(left.size, right.size), most = std::max({head.size, body.size, arms});
  if (-low / kNoticedHeight > most) return "dip";
  if (most == arms) {
    if (std::min(left.size, right.size) > 0.7f * arms) return "both arms";
    return left.size > right.size ? left.part : right.part;
  }
  if (most == head.size) return std::string("head ") + direction_of(head.turn, true);
  return std::string("body ") + direction_of(body.turn, false);
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
  name_ = describe(points) + ", " + seconds_text(seconds());
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
  constexpr float kMost = 10;
  if (!std::ranges::all_of(tensor.values, [](float v) { return std::abs(v) <= kMost; })) {
    return Error{name + ": tensor '" + key + "' holds a number beyond 10 radians or metres"};
  }
  std::vector<GesturePose> points(static_cast<size_t>(shape[0]));
  for (size_t i = 0; i < points.size(); ++i) {
    points[i] = unpack(std::span(tensor.values).subspan(i * GesturePose::kSize));
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
  const float place = time * kRate;
  const int last = static_cast<int>(place);
  const float x = place - static_cast<float>(last), y = 1 - x;
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
