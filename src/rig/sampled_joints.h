#pragma once
// Samples poses of a clip, and computes quantiles. Private to the folder.

#include <span>
#include <vector>

#include "clip/clip.h"

namespace panache {

// Some joints in some frames of the clip, in world space, file axes and units.
class SampledJoints {
 public:
  // Samples the joints `of` (-1: none) in every `step`-th frame of [first, end). Skips frames in
  // which one of them is not finite.
  SampledJoints(const Clip& clip, int first, int end, int step, std::span<const int> of);

  int count() const { return count_; }
  ConstPose world(int i) const {
    const size_t at = static_cast<size_t>(i) * joints_;
    return {std::span(rotations_).subspan(at, joints_),
            std::span(translations_).subspan(at, joints_)};
  }

 private:
  size_t joints_;
  int count_ = 0;
  std::vector<Quat> rotations_;
  std::vector<Vec3> translations_;
};

// The finite ones of the rest pose and a few poses of the motion: positions in world space, file
// axes and units.
std::vector<std::vector<Vec3>> some_poses(const Clip& clip);

// The `share` quantile of the values, linear between neighbours; 0 if there are none.
float quantile(std::vector<float> values, float share);

}  // namespace panache
