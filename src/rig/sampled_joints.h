#pragma once
// Some joints in some frames of a clip, and what is usual among numbers. Private to the folder.

#include <span>
#include <vector>

#include "clip/clip.h"

namespace panache {

// Some joints in some frames of the clip, in world space, file axes and units.
class SampledJoints {
 public:
  // Takes every `step`-th frame from `first` to before `end`, and of it the joints `of`, -1
  // standing for none. A frame in which one of them is nowhere says nothing and is left out.
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

// The value that a share of the numbers does not exceed, linear between neighbours; 0 of none.
float quantile(std::vector<float> values, float share);

}  // namespace panache
