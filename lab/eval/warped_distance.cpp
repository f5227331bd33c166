#include "eval/performer_judges.h"

#include <algorithm>
#include <limits>
#include <vector>

namespace panache {
namespace {

constexpr int kWindowHop = 15;  // Frames.

// Mean over the joints, metres. [frames of take][frames of real]
std::vector<float> distances(const Take& take, const Take& real) {
  std::vector<float> distance;
  distance.reserve(size_t(take.frames()) * real.frames());
  for (const HumanPositions& a : take.body) {
    for (const HumanPositions& b : real.body) {
      float sum = 0;
      for (int j = 0; j < kHumanJoints; ++j) sum += length(a[j] - b[j]);
      distance.push_back(sum / kHumanJoints);
    }
  }
  return distance;
}

// The minimal mean cost of a path through rows [first, first + rows). Dynamic time warping in which
// every step advances both (Sakoe and Chiba's slope constraint of 1): by 1 and 1, 1 and 2, or 2 and
// 1 frames.
float best_path(const std::vector<float>& distance, int columns, int first, int rows) {
  constexpr float kFar = std::numeric_limits<float>::infinity();
  std::vector<float> cost(size_t(rows) * columns, kFar);
  const auto at = [&](int row, int column) -> float {
    return row < 0 || column < 0 ? kFar : cost[size_t(row) * columns + column];
  };
  const auto own = [&](int row, int column) {
    return distance[size_t(first + row) * columns + column];
  };
  for (int i = 0; i < rows; ++i) {
    for (int j = 0; j < columns; ++j) {
      float before = i == 0 ? 0 : std::min(at(i - 1, j - 1), at(i - 1, j - 2));
      if (i > 0) before = std::min(before, at(i - 2, j - 1) + own(i - 1, j));
      cost[size_t(i) * columns + j] = before + own(i, j);
    }
  }
  const float best = *std::min_element(cost.end() - columns, cost.end());
  return best / static_cast<float>(rows);
}

}  // namespace

double warped_distance(const Take& take, const Take& real) {
  const std::vector<float> distance = distances(take, real);
  const int rows = std::min({kWarpedFrames, take.frames(), real.frames()});
  double sum = 0;
  int windows = 0;
  for (int first = 0; first + rows <= take.frames(); first += kWindowHop, ++windows) {
    sum += best_path(distance, real.frames(), first, rows);
  }
  return 100 * sum / windows;
}

}  // namespace panache
