#pragma once
// The distance between two poses.

#include <algorithm>

#include "rig/humanoid.h"

namespace panache {

// Mean and largest distance of the joints of two bodies in one space, metres.
struct PoseDistance {
  float mean = 0, largest = 0;
};
inline PoseDistance pose_distance(const HumanPositions& a, const HumanPositions& b) noexcept {
  PoseDistance out;
  for (size_t j = 0; j < a.size(); ++j) {
    const float apart = length(a[j] - b[j]);
    out.mean += apart / static_cast<float>(a.size());
    out.largest = std::max(out.largest, apart);
  }
  return out;
}

}  // namespace panache
