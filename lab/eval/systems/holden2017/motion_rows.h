#pragma once
// The input of the convolutional networks: rows of features over time.

#include <utility>
#include <vector>

#include <torch/types.h>

#include "base/random.h"
#include "learn/take.h"

namespace panache::holden2017 {

// Per frame: features in layout positions, and the contact of each foot.
inline constexpr int kPoseRows = pose_feature_count(PoseLayout::positions),
                     kRows = kPoseRows + kFeet;
inline constexpr int kWindow = 48;  // Frames per training window: 1.6 s.

// [kRows][frames], metres, not normalised.
torch::Tensor motion_rows(const Take& take);

// Normalisation of rows: (row - mean) / scale.
class RowUnits {
 public:
  // Measured on these motions, at least one.
  explicit RowUnits(const std::vector<torch::Tensor>& motions);
  torch::Tensor normalise(const torch::Tensor& rows) const { return (rows - mean_) / scale_; }
  torch::Tensor undo(const torch::Tensor& rows) const { return rows * scale_ + mean_; }

 private:
  torch::Tensor mean_, scale_;  // [kRows][1]
};

// Random windows of any motion, with equal weight for each frame.
class Windows {
 public:
  // `motions`: [kRows][frames] each. Shorter ones than a window are padded with their last frame.
  explicit Windows(const std::vector<torch::Tensor>& motions);
  bool empty() const { return motions_.empty(); }
  // [count][kRows][kWindow]; `which`: receives the motion of each window, if not null.
  torch::Tensor draw(int count, Random& random, std::vector<int>* which = nullptr) const;

 private:
  std::vector<torch::Tensor> motions_;
  std::vector<int64_t> ends_;  // Cumulative number of windows, including this motion.
};

}  // namespace panache::holden2017
