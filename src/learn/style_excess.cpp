#include "learn/style_excess.h"

#include <algorithm>
#include <cmath>

#include "learn/samples.h"

namespace panache {
namespace {

using enum HumanJoint;

constexpr double kSmooth = 0.08;    // Deviation of the filter; seconds.
constexpr float kOffFloor = 0.03f;  // Metres.

// What a styled take changes, frame by frame.
struct Change {
  std::array<Quat, kGestureJoints> turns{};  // World rotations in the heading frame.
  float height = 0, lift = 0, weight = 0;
};

float lift_of(const HumanPositions& body) {
  return std::clamp(lowest_foot(body), kOffFloor, 1.0f) - kOffFloor;
}

// Windows overlap; those whose middle is nearer count more.
std::vector<Change> changes_of(const std::vector<Take>& takes, int styled,
                               std::span<const Pairing> pairings) {
  const Take& take = takes[styled];
  std::vector<Change> changes(static_cast<size_t>(take.frames()));
  for (const Pairing& pairing : pairings) {
    if (pairing.styled != styled) continue;
    const Take& neutral = takes[pairing.neutral];
    const int count = static_cast<int>(pairing.neutral_frames.size());
    for (int i = 0; i < count; ++i) {
      const int frame = pairing.first + i;
      Change& change = changes[frame];
      const float weight = static_cast<float>(std::min(i + 1, count - i));
      const StyleDelta delta = change_between(take, frame, neutral, pairing.neutral_frames[i], 1);
      for (size_t j = 0; j < kGestureJoints; ++j) {
        const Quat turn = exp_rotation(delta.rotations[j]);
        Quat& sum = change.turns[j];
        if (change.weight == 0) sum = {0, 0, 0, 0};
        const float sign = dot(sum, turn) < 0 ? -weight : weight;
        sum = {sum.x + turn.x * sign, sum.y + turn.y * sign, sum.z + turn.z * sign,
               sum.w + turn.w * sign};
      }
      change.height += weight * delta.hips_height;
      change.lift +=
          weight * std::max(0.0f, lift_of(take.body[frame]) -
                                      lift_of(body_at(neutral, pairing.neutral_frames[i])));
      change.weight += weight;
    }
  }
  for (Change& change : changes) {
    if (change.weight == 0) continue;
    for (Quat& turn : change.turns) turn = normalized(turn);
    change.height /= change.weight;
    change.lift /= change.weight;
  }
  return changes;
}

// The usual change of a take: medians.
Change usual_change(const std::vector<Change>& changes) {
  Change usual;
  for (size_t j = 0; j < kGestureJoints; ++j) {
    Quat sum{0, 0, 0, 0};
    for (const Change& change : changes) {
      if (change.weight == 0) continue;
      const Quat q = change.turns[j];
      const float sign = dot(sum, q) < 0 ? -1.0f : 1.0f;
      sum = {sum.x + q.x * sign, sum.y + q.y * sign, sum.z + q.z * sign, sum.w + q.w * sign};
    }
    const Quat mean = normalized(sum);
    std::array<std::vector<float>, 3> axes;
    for (const Change& change : changes) {
      if (change.weight == 0) continue;
      const Vec3 v = log_rotation(change.turns[j] * conjugate(mean));
      axes[0].push_back(v.x), axes[1].push_back(v.y), axes[2].push_back(v.z);
    }
    usual.turns[j] = exp_rotation(Vec3{median(axes[0]), median(axes[1]), median(axes[2])}) * mean;
  }
  std::vector<float> heights;
  for (const Change& change : changes) {
    if (change.weight > 0) heights.push_back(change.height);
  }
  usual.height = median(heights);
  return usual;
}

// How far a joint of `beyond` (world rotations) is turned beyond another.
float turned(const std::array<Quat, kGestureJoints>& beyond, HumanJoint from, HumanJoint joint) {
  return length(log_rotation(conjugate(beyond[index(from)]) * beyond[index(joint)]));
}

std::array<float, kGestureParts> sizes_of(const GesturePose& pose) {
  std::array<Quat, kGestureJoints> world;
  for (int j = 0; j < kGestureJoints; ++j) {
    const Quat own = exp_rotation(pose.turns[j]);
    world[j] = j == 0 ? own : world[kHumanParent[j]] * own;
  }
  const auto arm = [&](HumanJoint upper, HumanJoint lower) {
    return std::max(turned(world, chest, upper), 0.7f * turned(world, chest, lower));
  };
  return {turned(world, chest, head),
          turned(world, hips, chest),
          length(pose.turns[0]),
          arm(left_upper_arm, left_lower_arm),
          arm(right_upper_arm, right_lower_arm),
          std::abs(pose.height),
          pose.lift};
}

// Rotation vectors that do not jump from one turn to the other.
Vec3 unwrapped(Vec3 turn, Vec3 before) {
  const float angle = length(turn);
  if (angle < 1e-3f) return turn;
  const Vec3 other = turn * ((angle - 6.2831853f) / angle);
  return length(other - before) < length(turn - before) ? other : turn;
}

// What goes beyond the usual change, each joint's part of it.
std::vector<GesturePose> beyond_usual(const std::vector<Change>& changes) {
  const Change usual = usual_change(changes);
  std::vector<GesturePose> poses(changes.size());
  for (size_t f = 0; f < changes.size(); ++f) {
    if (changes[f].weight == 0) continue;
    std::array<Quat, kGestureJoints> beyond;
    for (size_t j = 0; j < kGestureJoints; ++j) {
      beyond[j] = changes[f].turns[j] * conjugate(usual.turns[j]);
      const int parent = kHumanParent[j];
      const Quat own = parent < 0 ? beyond[j] : conjugate(beyond[parent]) * beyond[j];
      poses[f].turns[j] = unwrapped(log_rotation(own), f > 0 ? poses[f - 1].turns[j] : Vec3{});
    }
    poses[f].height = changes[f].height - usual.height;
    poses[f].lift = changes[f].lift;
  }
  return poses;
}

}  // namespace

float median(std::vector<float> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

std::vector<Excess> style_excess(const std::vector<Take>& takes, int styled,
                                 std::span<const Pairing> pairings) {
  const std::vector<Change> changes = changes_of(takes, styled, pairings);
  const std::vector<GesturePose> poses = beyond_usual(changes);
  const int frames = static_cast<int>(poses.size());
  const int reach = static_cast<int>(std::ceil(3 * kSmooth * kTakeRate));
  std::vector<Excess> excess(poses.size());
  for (int f = 0; f < frames; ++f) {
    float total = 0;
    for (int k = std::max(0, f - reach); k < std::min(frames, f + reach + 1); ++k) {
      if (changes[k].weight == 0) continue;
      const double x = (k - f) / (kSmooth * kTakeRate);
      const auto weight = static_cast<float>(std::exp(-x * x / 2));
      add_scaled(weight, poses[k], excess[f].pose);
      total += weight;
    }
    if (total == 0) continue;
    excess[f].pose = scaled(1 / total, excess[f].pose);
    excess[f].size = sizes_of(excess[f].pose);
  }
  return excess;
}

}  // namespace panache
