#pragma once
// Motion as the convolutional networks see it: rows of numbers over time.

#include <utility>
#include <vector>

#include <torch/types.h>

#include "base/random.h"
#include "learn/take.h"

namespace panache::holden2017 {

// Of each frame: its numbers in layout positions, and whether each foot is planted.
inline constexpr int kPoseRows = pose_feature_count(PoseLayout::positions),
                     kRows = kPoseRows + kFeet;
inline constexpr int kWindow = 48;  // Frames that the networks learn from at once: 1.6 s.

// [kRows][frames], metres and as they are.
torch::Tensor motion_rows(const Take& take);

// Rows less their mean, divided by their scale.
class RowUnits {
 public:
  // Measured on these motions, which are some.
  explicit RowUnits(const std::vector<torch::Tensor>& motions);
  torch::Tensor normalise(const torch::Tensor& rows) const { return (rows - mean_) / scale_; }
  torch::Tensor undo(const torch::Tensor& rows) const { return rows * scale_ + mean_; }

 private:
  torch::Tensor mean_, scale_;  // [kRows][1]
};

// Windows of any motion, each frame as likely as the next.
class Windows {
 public:
  // `motions`: [kRows][frames] each. Shorter ones than a window stand still at their end.
  explicit Windows(const std::vector<torch::Tensor>& motions);
  bool empty() const { return motions_.empty(); }
  // [count][kRows][kWindow]; `which`: the motion that each is of, where it is asked for.
  torch::Tensor draw(int count, Random& random, std::vector<int>* which = nullptr) const;

 private:
  std::vector<torch::Tensor> motions_;
  std::vector<int64_t> ends_;  // Windows of this motion and those before it.
};

}  // namespace panache::holden2017
