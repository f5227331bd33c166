#pragma once
// What happens to received poses before they are styled: mirroring and smoothing.

#include <span>
#include <vector>

#include "clip/clip.h"

namespace panache::cli {

class VmcFilter {
 public:
  // Seconds; the maximum of `smooth`.
  static constexpr double kMaxSmooth = 1;

  // `bones`: the bone of each joint (vmc_bones.h), whose rotations are relative to a T-pose.
  // `mirror` exchanges left and right, as a mirror does. `smooth`: the maximum delay of any
  // movement, seconds; 0: none.
  VmcFilter(std::span<const int> bones, bool mirror, double smooth);

  // Changes a pose in place, `seconds` after the last one.
  void apply(Pose pose, double seconds);
  // The next pose is not smoothed with those before.
  void reset() noexcept { stages_.clear(); }

 private:
  struct Stage {
    std::vector<Quat> rotations;
    std::vector<Vec3> translations;
  };
  void mirror(Pose pose);
  void smooth(Pose pose, double seconds);

  std::vector<size_t> twins_;  // The joint of the other side, or the joint itself. [joints]
  std::vector<bool> moves_;    // Root and hips: others keep their place in the parent. [joints]
  bool mirrors_;
  double smooth_;
  std::vector<Stage> stages_;  // Empty until the first pose.
};

}  // namespace panache::cli
