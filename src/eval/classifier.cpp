#include "eval/classifier.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "base/random.h"

namespace panache {
namespace {

constexpr int kHidden = 96, kLayers = 2;
constexpr int kNetworks = 2;
constexpr int kRows = 256;
// Rounds through the windows, and how many steps that may be.
constexpr int kRounds = 12, kMinSteps = 400, kMaxSteps = 2500;
constexpr float kNoise = 0.1f;  // Added to each number in training, in its deviations.

}  // namespace

Classifier::Classifier(const std::vector<Take>& takes, const std::vector<std::string>& labels,
                       std::vector<std::string> classes, uint64_t seed)
    : classes_(std::move(classes)) {
  std::vector<int> indices;
  for (const std::string& label : labels) indices.push_back(find(label));
  learn(takes, indices, seed);
}

int Classifier::find(const std::string& label) const {
  const auto found = std::find(classes_.begin(), classes_.end(), label);
  return found == classes_.end() ? -1 : static_cast<int>(found - classes_.begin());
}

void Classifier::write_window(const Take& take, int first, float* out) const {
  const int numbers = pose_feature_count(PoseLayout::positions);
  for (int p = 0; p < kClassifiedPoses; ++p) {
    const int frame = std::min(first + p * kClassifiedSpacing, take.frames() - 1);
    for (int i = 0; i < numbers; ++i) {
      *out++ = (take.pose_features[size_t(frame) * numbers + i] - mean_[i]) / scale_[i];
    }
  }
}

void Classifier::learn(const std::vector<Take>& takes, const std::vector<int>& labels,
                       uint64_t seed) {
  const int numbers = pose_feature_count(PoseLayout::positions),
            inputs = kClassifiedPoses * numbers;
  std::vector<std::vector<std::pair<int, int>>> windows(classes_.size());  // Take, first frame.
  std::vector<double> sum(numbers), squares(numbers);
  double poses = 0;
  for (size_t t = 0; t < takes.size(); ++t) {
    if (labels[t] < 0) continue;
    const int last = takes[t].frames() - 1 - (kClassifiedPoses - 1) * kClassifiedSpacing;
    for (int f = 0; f <= std::max(0, last); ++f) windows[labels[t]].push_back({int(t), f});
    for (size_t i = 0; i < takes[t].pose_features.size(); ++i) {
      sum[i % numbers] += takes[t].pose_features[i];
      squares[i % numbers] += double(takes[t].pose_features[i]) * takes[t].pose_features[i];
    }
    poses += takes[t].frames();
  }
  for (int i = 0; i < numbers; ++i) {
    const double mean = sum[i] / std::max(1.0, poses);
    const double variance = squares[i] / std::max(1.0, poses) - mean * mean;
    const double floor = i < root_offset(PoseLayout::positions) ? 0.02 : 0.1;
    mean_.push_back(static_cast<float>(mean));
    scale_.push_back(static_cast<float>(std::sqrt(std::max(variance, 0.0) + floor * floor)));
  }

  size_t count = 0;
  for (const auto& w : windows) count += w.size();
  const int steps = std::clamp(static_cast<int>(kRounds * count / kRows), kMinSteps, kMaxSteps);
  // Classes are drawn by the square root of their share.
  std::vector<float> share;
  float total = 0;
  for (const auto& w : windows) {
    share.push_back(total += std::sqrt(static_cast<float>(w.size())));
  }
  OptimizerSettings settings;
  settings.learning_rate = 0.002f;
  settings.one_cycle = true;
  settings.weight_decay = 0.1f;
  settings.dropout = 0.2f;
  const NetworkShape shape{"classifier", inputs, kHidden, kLayers, int(classes_.size()), 1};
  for (int n = 0; n < kNetworks; ++n) {
    networks_.emplace_back(shape, settings, steps, seed * 977 + n);
  }
  const auto work = [&](int n) {
    Random random(seed * 7919 + n);
    torch::Tensor x = torch::empty({kRows, inputs});
    torch::Tensor label = torch::empty({kRows}, torch::kInt64);
    for (int step = 0; step < steps; ++step) {
      for (int r = 0; r < kRows; ++r) {
        const float at = random.uniform() * total;
        const size_t c = std::min<size_t>(
            std::upper_bound(share.begin(), share.end(), at) - share.begin(), share.size() - 1);
        const auto [take, first] =
            windows[c][random.below(static_cast<uint32_t>(windows[c].size()))];
        float* out = x.data_ptr<float>() + size_t(r) * inputs;
        write_window(takes[take], first, out);
        for (int i = 0; i < inputs; ++i) out[i] += kNoise * random.normal();
        label.data_ptr<int64_t>()[r] = static_cast<int64_t>(c);
      }
      const torch::Tensor out = networks_[n].forward(x, {}, &random);
      networks_[n].learn(torch::nn::functional::cross_entropy(out, label));
    }
  };
  parallel_for(kNetworks, work);
}

Classification Classifier::classify(const Take& take) const {
  torch::NoGradGuard no_gradients;
  const int span = (kClassifiedPoses - 1) * kClassifiedSpacing;
  const int count = 1 + std::max(0, take.frames() - 1 - span) / kClassifiedHop;
  const int inputs = kClassifiedPoses * pose_feature_count(PoseLayout::positions);
  const torch::Tensor x = torch::empty({count, inputs});
  for (int w = 0; w < count; ++w) {
    write_window(take, w * kClassifiedHop, x.data_ptr<float>() + size_t(w) * inputs);
  }
  Classification classified{torch::zeros({count, static_cast<int64_t>(classes_.size())}), {}};
  for (const NetworkTrainer& network : networks_) {
    classified.probabilities += torch::softmax(network.forward(x, {}, nullptr), 1) / kNetworks;
  }
  classified.features = networks_.front().hidden(x, nullptr);
  return classified;
}

}  // namespace panache
