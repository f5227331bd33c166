#include "learn/find_gestures.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "base/smooth_step.h"
#include "learn/style_excess.h"

namespace panache {
namespace {

using Parts = std::array<float, kGestureParts>;
using ExcessOfTakes = std::map<int, std::vector<Excess>>;  // By take, [frames].

// Found on the takes of 60 styles of CMU's performers, of which scared, shy, drunk and clumsy ones
// have gestures that people name, and steady walks have none.

// From how much on a part is in a gesture whatever is usual, and is so in any case: radians,
// metres.
constexpr Parts kLeast = {0.35f, 0.30f, 0.30f, 0.6f, 0.6f, 0.07f, 0.04f};
constexpr Parts kAlways = {0.6f, 0.5f, 0.6f, 1.8f, 1.8f, 0.16f, 0.08f};
constexpr float kDeviations = 3;  // Beyond the median, of a normal distribution.
constexpr float kClear = 1.15f;   // Of that limit: a gesture's peak.
// Of its peak: where a gesture begins and ends; where it may be cut short; and a stronger one near
// it, on whose slope it is.
constexpr float kQuiet = 0.4f, kFairlyQuiet = 0.7f, kStronger = 1.15f;
constexpr float kMovesAlong = 0.75f;            // Of its limit: a part that is in the gesture, too.
constexpr int kShortest = 9, kLongest = 75;     // Frames from the beginning to the end.
constexpr int kEdge = 12;                       // Frames at each end of a take that are left out.
constexpr float kMaxTurn = 0.9f;                // Of the heading within a gesture, radians.
constexpr float kWalks = 0.4f, kStops = 0.35f;  // m/s; and the share of it that counts as standing.
constexpr double kEase = 0.2;                   // Before the beginning and after the end; seconds.

struct Moment {
  int take = 0, first = 0, last = 0;  // Frames of the take.
  float strength = 0;
};

// What leaves the usual range of each part.
Parts limits_of(const ExcessOfTakes& excess) {
  Parts limits;
  for (size_t p = 0; p < kGestureParts; ++p) {
    std::vector<float> sizes, apart;
    for (const auto& [take, frames] : excess) {
      for (const Excess& frame : frames) sizes.push_back(frame.size[p]);
    }
    const float usual = median(sizes);
    for (const float size : sizes) apart.push_back(std::abs(size - usual));
    // Of a normal distribution, a deviation is 1.4826 of these.
    const float wide = usual + kDeviations * 1.4826f * median(std::move(apart));
    limits[p] = std::clamp(wide, kLeast[p], kAlways[p]);
  }
  return limits;
}

// Of each frame the part that is furthest beyond its limit, as a share of the limit.
std::vector<float> scores_of(const std::vector<Excess>& frames, const Parts& limits) {
  std::vector<float> scores;
  for (const Excess& frame : frames) {
    float score = 0;
    for (size_t p = 0; p < kGestureParts; ++p) score = std::max(score, frame.size[p] / limits[p]);
    scores.push_back(score);
  }
  return scores;
}

// From the peak forwards (`way` 1) or backwards (-1) to where it is quiet; nothing if it is not.
std::optional<int> end_of(const std::vector<float>& scores, int peak, int way) {
  const int end = static_cast<int>(scores.size()) - kEdge;
  int quietest = peak;
  for (int f = peak; f >= kEdge && f < end && std::abs(f - peak) <= kLongest / 2; f += way) {
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

// Whether a body turns around, stops or starts, rather than making a gesture on its way.
bool changes_course(const Take& take, int first, int last, float speed) {
  if (std::abs(take.root[last].facing - take.root[first].facing) > kMaxTurn) return true;
  const float way = length(take.root[last].position - take.root[first].position);
  const float pace = way * static_cast<float>(kTakeRate) / static_cast<float>(last - first);
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

// The strongest that do not overlap.
std::vector<Moment> strongest(std::vector<Moment> moments) {
  std::stable_sort(moments.begin(), moments.end(),
                   [](const Moment& a, const Moment& b) { return a.strength > b.strength; });
  std::vector<Moment> kept;
  for (const Moment& moment : moments) {
    const bool overlaps = std::ranges::any_of(kept, [&](const Moment& other) {
      return other.take == moment.take && other.first < moment.last && moment.first < other.last;
    });
    if (!overlaps && kept.size() < kFoundGestures) kept.push_back(moment);
  }
  return kept;
}

// Which joints a gesture turns, and whether it moves the hips.
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
  using enum HumanJoint;
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
    const double at = begin + (k + 2) * step;  // The middle of what this control point weighs in.
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

std::vector<FoundGesture> find_gestures(const std::vector<Take>& takes,
                                        std::span<const Pairing> pairings) {
  ExcessOfTakes excess;
  for (const Pairing& pairing : pairings) {
    if (excess.contains(pairing.styled)) continue;
    excess[pairing.styled] = style_excess(takes, pairing.styled, pairings);
  }
  const Parts limits = limits_of(excess);
  std::vector<Moment> moments;
  for (const auto& [take, frames] : excess) {
    add_moments(takes[take], take, scores_of(frames, limits), moments);
  }
  std::vector<FoundGesture> found;
  for (const Moment& moment : strongest(std::move(moments))) {
    const std::vector<Excess>& frames = excess[moment.take];
    const double begin = std::max(0.0, moment.first / kTakeRate - kEase);
    found.push_back({make_gesture(frames, moment, moving_parts(frames, moment, limits), begin),
                     moment.take, begin, moment.strength});
  }
  return found;
}

}  // namespace panache
