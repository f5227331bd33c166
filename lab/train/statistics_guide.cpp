#include "train/statistics_guide.h"

#include <algorithm>

#include <torch/nn/functional/loss.h>

#include "train/classifier.h"

namespace panache {
namespace {

constexpr int kHop = 5;                                // Frames between the starts of two windows.
constexpr float kStillSpeed = 0.05f;                   // m/s, added before the logarithm.
constexpr float kHeightUnit = 0.2f, kBobUnit = 0.03f;  // Metres.
constexpr double kTemperature = 4;  // Divides the scores, which are overconfident.
// Bone directions, their deviations, joint speeds, height of the hips.
constexpr int kStatistics = 6 * (kHumanJoints - 1) + kHumanJoints + 2;

// Windows of a take. [windows][kClassifiedPoses][21][3]
torch::Tensor windows_of(const Take& take) {
  const int span = (kClassifiedPoses - 1) * kClassifiedSpacing;
  const int count = 1 + std::max(0, take.frames() - 1 - span) / kHop;
  torch::Tensor bodies = torch::empty({count, kClassifiedPoses, kHumanJoints, 3});
  float* to = bodies.data_ptr<float>();
  for (int w = 0; w < count; ++w) {
    for (int p = 0; p < kClassifiedPoses; ++p) {
      const int frame = std::min(w * kHop + p * kClassifiedSpacing, take.frames() - 1);
      for (const Vec3& joint : take.body[frame]) *to++ = joint.x, *to++ = joint.y, *to++ = joint.z;
    }
  }
  return bodies;
}

torch::Tensor deviation(const torch::Tensor& rows) {
  const torch::Tensor variance = rows.square().mean(1) - rows.mean(1).square();
  return (variance.clamp_min(0) + 1e-6).sqrt();
}

// Statistics of all windows of a take. [windows][kStatistics]
torch::Tensor statistics_of(const Take& take) {
  return motion_statistics(windows_of(take)).to(torch::kFloat64);
}

}  // namespace

const torch::Tensor& bone_parents() {
  static const torch::Tensor parents = [] {
    std::vector<int64_t> list;
    for (int j = 1; j < kHumanJoints; ++j) list.push_back(kHumanParent[j]);
    return torch::tensor(list);
  }();
  return parents;
}

torch::Tensor motion_statistics(const torch::Tensor& bodies) {
  const int64_t n = bodies.size(0);
  const torch::Tensor bones = bodies.slice(2, 1) - bodies.index_select(2, bone_parents());
  const torch::Tensor directions = bones / (bones.square().sum(3, true) + 1e-8).sqrt();
  const torch::Tensor step = bodies.slice(1, 1) - bodies.slice(1, 0, -1);
  const torch::Tensor speed =
      (step.square().sum(3) + 1e-10).sqrt().mean(1) * (kTakeRate / kClassifiedSpacing);
  const torch::Tensor height = bodies.select(2, 0).select(2, 1);
  return torch::cat({directions.mean(1).reshape({n, -1}), deviation(directions).reshape({n, -1}),
                     (speed + kStillSpeed).log(), height.mean(1, true) / kHeightUnit,
                     deviation(height).unsqueeze(1) / kBobUnit},
                    1);
}

StatisticsGuide::StatisticsGuide(const std::vector<Take>& takes,
                                 const std::vector<std::string>& labels,
                                 const std::vector<std::string>& classes)
    : discriminant_(rows_of_classes(takes, labels, classes, kStatistics, statistics_of)) {}

torch::Tensor StatisticsGuide::loss(const torch::Tensor& bodies, const torch::Tensor& wanted,
                                    float smoothing) const {
  const torch::Tensor scores = discriminant_.scores(motion_statistics(bodies).to(torch::kFloat64));
  return torch::nn::functional::cross_entropy(
      (scores / kTemperature).to(torch::kFloat32), wanted,
      torch::nn::functional::CrossEntropyFuncOptions().label_smoothing(smoothing));
}

}  // namespace panache
