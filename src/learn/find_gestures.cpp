#include "learn/find_gestures.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "base/elementary.h"
#include "learn/samples.h"

namespace panache {
namespace {

using enum HumanJoint;

// Parts of the body that a gesture may move.
enum GesturePart { kHead, kTorso, kHips, kLeftArm, kRightArm, kHeight, kLift, kGestureParts };

struct Excess {
  GesturePose pose;  // Added to the usual change; zero where nothing is paired.
  // Of each part: its rotation relative to its parent, radians; metres for height and lift.
  std::array<float, kGestureParts> size{};
};

// The median; 0 if empty.
float median(std::vector<float> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + values.size() / 2;
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

constexpr double kSmooth = 0.08;    // Standard deviation of the filter; seconds.
constexpr float kOffFloor = 0.03f;  // Metres.

// The change in each frame of a styled take.
struct Change {
  std::array<Quat, kGestureJoints> turns{};  // World rotations in the heading frame.
  float height = 0, lift = 0, weight = 0;
};

float lift_of(const HumanPositions& body) {
  return std::clamp(lowest_foot(body), kOffFloor, 1.0f) - kOffFloor;
}

// Windows overlap; those with a nearer middle weigh more.
std::vector<Change> changes_of(const std::vector<Take>& takes, int styled,
                               std::span<const Pairing> pairings) {
  const Take& take = takes[styled];
  std::vector<Change> changes(take.frames());
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

// The usual change of a take: its medians.
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

// How far a joint of `beyond` (world rotations) is turned relative to another.
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

// Rotation vectors without jumps by a full turn.
Vec3 unwrapped(Vec3 turn, Vec3 before) {
  const float angle = length(turn);
  if (angle < 1e-3f) return turn;
  const Vec3 other = turn * ((angle - 6.2831853f) / angle);
  return length(other - before) < length(turn - before) ? other : turn;
}

// The excess over the usual change, as local rotations.
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

// For each frame of takes[styled]: the difference between its change from the paired neutral motion
// and the take's median change, smoothed over about 0.1 s.
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

using Parts = std::array<float, kGestureParts>;
using ExcessOfTakes = std::map<int, std::vector<Excess>>;  // By take, [frames].

// Tuned on takes of 60 styles by CMU's performers: scared, shy, drunk and clumsy ones have gestures
// that people name, and steady walks have none.

// Excess below which a part is never in a gesture, and above which it always is: radians, metres.
constexpr Parts kMin = {0.35f, 0.30f, 0.30f, 0.6f, 0.6f, 0.07f, 0.04f};
constexpr Parts kAlways = {0.6f, 0.5f, 0.6f, 1.8f, 1.8f, 0.16f, 0.08f};
constexpr float kDeviations = 3;  // Standard deviations beyond the median.
constexpr float kClear = 1.15f;   // A gesture's peak, relative to that limit.
// Relative to the peak: where a gesture begins and ends; where it may be cut short; and a nearby
// stronger peak, on whose slope it is.
constexpr float kQuiet = 0.4f, kFairlyQuiet = 0.7f, kStronger = 1.15f;
constexpr float kMovesAlong = 0.75f;            // Times its limit: another part of the gesture.
constexpr int kShortest = 9, kLongest = 75;     // Frames from the beginning to the end.
constexpr int kEdge = 12;                       // Frames ignored at each end of a take.
constexpr float kMaxTurn = 0.9f;                // Change of heading within a gesture, radians.
constexpr float kWalks = 0.4f, kStops = 0.35f;  // m/s; and the fraction that counts as standing.
constexpr double kEase = 0.2;                   // Before the beginning and after the end; seconds.

struct Moment {
  int take = 0, first = 0, last = 0;  // Frames of the take.
  float strength = 0;
};

// Limits of the usual range of each part.
Parts limits_of(const ExcessOfTakes& excess) {
  Parts limits;
  for (size_t p = 0; p < kGestureParts; ++p) {
    std::vector<float> sizes, apart;
    for (const auto& [take, frames] : excess) {
      for (const Excess& frame : frames) sizes.push_back(frame.size[p]);
    }
    const float usual = median(sizes);
    for (const float size : sizes) apart.push_back(std::abs(size - usual));
    // For a normal distribution, the deviation is 1.4826 times the median absolute deviation.
    const float bound = usual + kDeviations * 1.4826f * median(std::move(apart));
    limits[p] = std::clamp(bound, kMin[p], kAlways[p]);
  }
  return limits;
}

// For each frame, the largest excess of a part relative to its limit.
std::vector<float> scores_of(const std::vector<Excess>& frames, const Parts& limits) {
  std::vector<float> scores;
  for (const Excess& frame : frames) {
    float score = 0;
    for (size_t p = 0; p < kGestureParts; ++p) score = std::max(score, frame.size[p] / limits[p]);
    scores.push_back(score);
  }
  return scores;
}

// From the peak forwards (`direction` 1) or backwards (-1) to where it is quiet; nothing if it
// never is.
std::optional<int> end_of(const std::vector<float>& scores, int peak, int direction) {
  const int end = static_cast<int>(scores.size()) - kEdge;
  int quietest = peak;
  for (int f = peak; f >= kEdge && f < end && std::abs(f - peak) <= kLongest / 2; f += direction) {
    if (scores[f] > kStronger * scores[peak]) return {};
    if (scores[f] <= scores[quietest]) quietest = f;
    if (scores[f] < kQuiet * scores[peak]) break;
  }
  if (scores[quietest] >= kFairlyQuiet * scores[peak]) return {};
  return quietest;
}

float usual_speed(const Take& take) {
  std::vector<float> steps;
  for (int f = 1; f < take.frames(); ++f) {
    steps.push_back(length(take.root[f].position - take.root[f - 1].position));
  }
  return median(std::move(steps)) * static_cast<float>(kTakeRate);
}

// Whether the body turns around, stops or starts, which is not a gesture.
bool changes_course(const Take& take, int first, int last, float speed) {
  if (std::abs(take.root[last].facing - take.root[first].facing) > kMaxTurn) return true;
  const float distance = length(take.root[last].position - take.root[first].position);
  const float pace = distance * static_cast<float>(kTakeRate) / static_cast<float>(last - first);
  return speed > kWalks && pace < kStops * speed;
}

void add_moments(const Take& take, int number, const std::vector<float>& scores,
                 std::vector<Moment>& out) {
  const float speed = usual_speed(take);
  for (int f = kEdge; f < static_cast<int>(scores.size()) - kEdge; ++f) {
    if (scores[f] < kClear || scores[f] < scores[f - 1] || scores[f] < scores[f + 1]) continue;
    const std::optional<int> first = end_of(scores, f, -1), last = end_of(scores, f, 1);
    if (!first || !last || *last - *first < kShortest || *last - *first > kLongest) continue;
    if (changes_course(take, *first, *last, speed)) continue;
    out.push_back({number, *first, *last, scores[f]});
  }
}

// The moments that do not overlap stronger ones, strongest first.
std::vector<Moment> without_overlap(std::vector<Moment> moments) {
  std::stable_sort(moments.begin(), moments.end(),
                   [](const Moment& a, const Moment& b) { return a.strength > b.strength; });
  std::vector<Moment> kept;
  for (const Moment& moment : moments) {
    const bool overlaps = std::ranges::any_of(kept, [&](const Moment& other) {
      return other.take == moment.take && other.first < moment.last && moment.first < other.last;
    });
    if (!overlaps) kept.push_back(moment);
  }
  return kept;
}

// The joints that a gesture rotates, and whether it moves the hips.
struct Moving {
  std::array<bool, kGestureJoints> joints{};
  bool hips = false;
};
Moving moving_parts(const std::vector<Excess>& frames, const Moment& moment, const Parts& limits) {
  std::array<bool, kGestureParts> moves{};
  for (int f = moment.first; f <= moment.last; ++f) {
    for (size_t p = 0; p < kGestureParts; ++p) {
      moves[p] = moves[p] || frames[f].size[p] > kMovesAlong * limits[p];
    }
  }
  Moving moving;
  moving.hips = moves[kHips] || moves[kHeight] || moves[kLift];
  for (int j = 0; j < kGestureJoints; ++j) {
    moving.joints[j] = j == index(hips)        ? moving.hips
                       : j <= index(chest)     ? moving.hips || moves[kTorso]
                       : j <= index(head)      ? moves[kHead]
                       : j <= index(left_hand) ? moves[kLeftArm]
                                               : moves[kRightArm];
  }
  return moving;
}

Gesture make_gesture(const std::vector<Excess>& frames, const Moment& moment, const Moving& moving,
                     double begin) {
  const double end = moment.last / kTakeRate + kEase, step = 1 / double(Gesture::kRate);
  const int count = static_cast<int>(std::lround((end - begin) / step)) - 3;
  std::vector<GesturePose> points;
  for (int k = 0; k < std::clamp(count, Gesture::kMinPoints, Gesture::kMaxPoints); ++k) {
    const double at = begin + (k + 2) * step;  // The middle of this control point's range.
    const int last = static_cast<int>(frames.size()) - 1;
    const int frame = std::clamp(static_cast<int>(std::lround(at * kTakeRate)), 0, last);
    const auto share = static_cast<float>(std::min(at - begin, end - at) / (1.5 * kEase));
    GesturePose point = scaled(smooth_step(share), frames[frame].pose);
    for (size_t j = 0; j < kGestureJoints; ++j) {
      if (!moving.joints[j]) point.turns[j] = {};
    }
    if (!moving.hips) point.height = point.lift = 0;
    points.push_back(point);
  }
  return Gesture(points);
}

}  // namespace

FoundGestures find_gestures(const std::vector<Take>& takes, std::span<const Pairing> pairings) {
  ExcessOfTakes excess;
  for (const Pairing& pairing : pairings) {
    if (excess.contains(pairing.styled)) continue;
    excess[pairing.styled] = style_excess(takes, pairing.styled, pairings);
  }
  const Parts limits = limits_of(excess);
  std::vector<Moment> moments;
  double seconds = 0;
  for (const auto& [take, frames] : excess) {
    add_moments(takes[take], take, scores_of(frames, limits), moments);
    seconds += takes[take].frames() / kTakeRate;
  }
  moments = without_overlap(std::move(moments));
  FoundGestures found;
  if (seconds > 0) found.rate = static_cast<float>(static_cast<double>(moments.size()) / seconds);
  moments.resize(std::min(moments.size(), size_t{kFoundGestures}));
  std::vector<Gesture> gestures;
  std::vector<double> begins;
  for (const Moment& moment : moments) {
    const std::vector<Excess>& frames = excess[moment.take];
    begins.push_back(std::max(0.0, moment.first / kTakeRate - kEase));
    gestures.push_back(
        make_gesture(frames, moment, moving_parts(frames, moment, limits), begins.back()));
  }
  name_gestures(gestures);
  for (size_t g = 0; g < gestures.size(); ++g) {
    found.gestures.push_back({gestures[g], moments[g].take, begins[g], moments[g].strength});
  }
  return found;
}

}  // namespace panache
