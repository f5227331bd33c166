#include "eval/discriminant.h"

#include <algorithm>
#include <cmath>

namespace panache {
namespace {

constexpr int kLearntHop = 15, kHop = 10;  // Frames between the starts of two windows.
constexpr int kBones = kHumanJoints - 1;
// Bone directions, their deviations, joint speeds, height of the hips.
constexpr int kStatistics = 3 * kBones + 3 * kBones + kHumanJoints + 2;
constexpr float kStillSpeed = 0.05f;                   // m/s, added before the logarithm.
constexpr float kHeightUnit = 0.2f, kBobUnit = 0.03f;  // Metres.

void write_statistics(const std::vector<HumanPositions>& body, int first, int window_frames,
                      float* out) {
  const int last = std::min(first + window_frames, static_cast<int>(body.size()));
  const float frames = static_cast<float>(last - first);
  float* mean = out;
  float* deviation = out + 3 * kBones;
  float* speed = out + 6 * kBones;
  std::fill_n(out, kStatistics, 0.0f);
  float height = 0, squared_height = 0;
  for (int f = first; f < last; ++f) {
    for (int j = 1; j < kHumanJoints; ++j) {
      const Vec3 bone = body[f][j] - body[f][kHumanParent[j]];
      const Vec3 direction = bone / std::max(length(bone), 1e-6f);
      for (int n = 0; n < 3; ++n) {
        mean[3 * (j - 1) + n] += direction[n] / frames;
        deviation[3 * (j - 1) + n] += direction[n] * direction[n] / frames;
      }
    }
    height += body[f][0].y / frames;
    squared_height += body[f][0].y * body[f][0].y / frames;
    if (f == first) continue;
    for (int j = 0; j < kHumanJoints; ++j) {
      speed[j] +=
          length(body[f][j] - body[f - 1][j]) * static_cast<float>(kTakeRate) / (frames - 1);
    }
  }
  for (int n = 0; n < 3 * kBones; ++n) {
    deviation[n] = std::sqrt(std::max(deviation[n] - mean[n] * mean[n], 0.0f));
  }
  for (int j = 0; j < kHumanJoints; ++j) speed[j] = std::log(kStillSpeed + speed[j]);
  out[kStatistics - 2] = height / kHeightUnit;
  out[kStatistics - 1] = std::sqrt(std::max(squared_height - height * height, 0.0f)) / kBobUnit;
}

// Statistics of the windows of a take, or of a shorter take as a whole. [windows][kStatistics]
torch::Tensor statistics(const Take& take, int window_frames, int hop) {
  const int windows = 1 + std::max(0, take.frames() - window_frames) / hop;
  torch::Tensor rows = torch::empty({windows, kStatistics});
  for (int w = 0; w < windows; ++w) {
    write_statistics(take.body, w * hop, window_frames,
                     rows.data_ptr<float>() + size_t(w) * kStatistics);
  }
  return rows.to(torch::kFloat64);
}

}  // namespace

Discriminant::Discriminant(const std::vector<Take>& takes, const std::vector<std::string>& labels,
                           const std::vector<std::string>& classes, int window_frames,
                           const std::vector<torch::Tensor>& shifts)
    : window_frames_(window_frames),
      discriminant_(rows_of_classes(takes, labels, classes, kStatistics, [&](const Take& take) {
        const torch::Tensor rows = statistics(take, window_frames, kLearntHop);
        return shifts.empty() ? rows : rows + shifts[static_cast<size_t>(&take - takes.data())];
      })) {}

torch::Tensor Discriminant::scores(const Take& take, const torch::Tensor& shift) const {
  torch::NoGradGuard no_gradients;
  const torch::Tensor rows = statistics(take, window_frames_, kHop);
  return discriminant_.scores(shift.defined() ? rows + shift : rows);
}

torch::Tensor Discriminant::mean_statistics(const Take& take, int window_frames) {
  return statistics(take, window_frames, kLearntHop).mean(0);
}

torch::Tensor Discriminant::mean_statistics(const Take& take) const {
  return mean_statistics(take, window_frames_);
}

}  // namespace panache
