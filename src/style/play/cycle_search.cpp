#include "style/play/cycle_search.h"

#include <algorithm>
#include <cmath>

#include "pose/pose_distance.h"

namespace panache {
namespace {

// Two poses match if their joints are this close, on average and each. Metres. Cycles of one
// person's walk differ by two to three centimetres in the mean.
constexpr float kMaxDistance = 0.04f, kMaxDistanceEach = 0.15f;
constexpr double kCandidates = 1.0 / 60;  // Seconds between compared poses.

}  // namespace

std::optional<double> find_cycle(const InputRing& ring, double at, double nearest,
                                 double farthest) noexcept {
  const HumanPositions here = ring.body(at), before = ring.body(at - kBeforeCycle);
  std::optional<double> best;
  float min = kMaxDistance;
  const int candidates = static_cast<int>(std::floor((farthest - nearest) / kCandidates)) + 1;
  for (int c = 0; c < candidates; ++c) {
    const double away = nearest + c * kCandidates, to = at + away;
    const PoseDistance now = pose_distance(here, ring.body(to)),
                       then = pose_distance(before, ring.body(to - kBeforeCycle));
    const float mean = (now.mean + then.mean) / 2;
    if (mean >= min || std::max(now.largest, then.largest) > kMaxDistanceEach) continue;
    min = mean;
    best = away;
  }
  return best;
}

}  // namespace panache
