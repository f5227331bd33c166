#include "train/classifier.h"

#include <algorithm>
#include <cmath>

#include <torch/nn/functional/loss.h>

#include "base/parallel.h"
#include "base/random.h"
#include "learn/disturbance.h"

namespace panache {
namespace {

constexpr int kNumbers = pose_feature_count(PoseLayout::positions);
constexpr int kLayers = 2;
constexpr int kRows = 256;
// Epochs, and limits of the number of steps.
constexpr int kRounds = 12, kMinSteps = 400, kMaxSteps = 2500;
constexpr float kNoise = 0.1f;  // Added to each input in training, in standard deviations.
constexpr Disturbance kDisturbance = {
    .scale = 0.06f, .floor = 0.015f, .heading = 0.1f, .posture = 0.3f};

void copy_window(const Take& take, int first, std::span<float> out) {
  for (int p = 0; p < kClassifiedPoses; ++p) {
    const int frame = std::min(first + p * kClassifiedSpacing, take.frames() - 1);
    std::copy_n(&take.pose_features[size_t(frame) * kNumbers], kNumbers,
                &out[size_t(p) * kNumbers]);
  }
}

}  // namespace

Classifier::Classifier(const std::vector<Take>& takes, const std::vector<std::string>& labels,
                       std::vector<std::string> classes, uint64_t seed,
                       const ClassifierSettings& settings)
    : settings_(settings), classes_(std::move(classes)) {
  std::vector<int> indices;
  indices.reserve(labels.size());
  for (const std::string& label : labels) indices.push_back(find(label));
  measure(takes, indices);
  learn(takes, indices, seed);
}

int Classifier::find(const std::string& label) const {
  const auto found = std::find(classes_.begin(), classes_.end(), label);
  return found == classes_.end() ? -1 : static_cast<int>(found - classes_.begin());
}

void Classifier::normalise(std::span<float> window) const {
  for (size_t i = 0; i < window.size(); ++i) {
    window[i] = (window[i] - units_.mean[i % kNumbers]) / units_.scale[i % kNumbers];
  }
}

void Classifier::measure(const std::vector<Take>& takes, const std::vector<int>& labels) {
  std::vector<double> sum(kNumbers), squares(kNumbers);
  double poses = 0;
  for (size_t t = 0; t < takes.size(); ++t) {
    if (labels[t] < 0) continue;
    for (size_t i = 0; i < takes[t].pose_features.size(); ++i) {
      sum[i % kNumbers] += takes[t].pose_features[i];
      squares[i % kNumbers] += double(takes[t].pose_features[i]) * takes[t].pose_features[i];
    }
    poses += takes[t].frames();
  }
  for (int i = 0; i < kNumbers; ++i) {
    const double mean = sum[i] / std::max(1.0, poses);
    const double variance = squares[i] / std::max(1.0, poses) - mean * mean;
    const double floor = i < root_offset(PoseLayout::positions) ? 0.02 : 0.1;
    units_.mean.push_back(static_cast<float>(mean));
    units_.scale.push_back(static_cast<float>(std::sqrt(std::max(variance, 0.0) + floor * floor)));
  }
}

void Classifier::learn(const std::vector<Take>& takes, const std::vector<int>& labels,
                       uint64_t seed) {
  std::vector<std::vector<std::pair<int, int>>> windows(classes_.size());  // Take, first frame.
  size_t count = 0;
  for (size_t t = 0; t < takes.size(); ++t) {
    if (labels[t] < 0) continue;
    const int last = takes[t].frames() - 1 - (kClassifiedPoses - 1) * kClassifiedSpacing;
    for (int f = 0; f <= std::max(0, last); ++f) windows[labels[t]].push_back({int(t), f});
    count += 1 + std::max(0, last);
  }
  const int rounds = std::clamp(static_cast<int>(kRounds * count / kRows), kMinSteps, kMaxSteps);
  const int steps = settings_.steps > 0 ? settings_.steps : rounds;
  // Classes are sampled by the square root of their share.
  std::vector<float> share;
  share.reserve(windows.size());
  float total = 0;
  for (const auto& w : windows) {
    share.push_back(total += std::sqrt(static_cast<float>(w.size())));
  }
  OptimizerSettings optimizer;
  optimizer.learning_rate = 0.002f;
  optimizer.one_cycle = true;
  optimizer.weight_decay = 0.1f;
  optimizer.dropout = 0.2f;
  const NetworkShape shape{"classifier", kClassifiedInputs,    settings_.hidden,
                           kLayers,      int(classes_.size()), 1};
  for (int n = 0; n < settings_.networks; ++n) {
    networks_.emplace_back(shape, optimizer, steps, seed * 977 + n);
  }
  const auto work = [&](int n) {
    Random random(seed * 7919 + n);
    torch::Tensor x = torch::empty({kRows, kClassifiedInputs});
    torch::Tensor label = torch::empty({kRows}, torch::kInt64);
    for (int step = 0; step < steps; ++step) {
      for (int r = 0; r < kRows; ++r) {
        const float at = random.uniform() * total;
        const size_t c = std::min<size_t>(
            std::upper_bound(share.begin(), share.end(), at) - share.begin(), share.size() - 1);
        const auto [take, first] =
            windows[c][random.below(static_cast<uint32_t>(windows[c].size()))];
        const std::span out(x.data_ptr<float>() + size_t(r) * kClassifiedInputs, kClassifiedInputs);
        copy_window(takes[take], first, out);
        if (settings_.disturbed) {
          disturb(draw_disturbance(kDisturbance, units_, random), kDisturbance, random, out);
        }
        normalise(out);
        for (float& number : out) number += kNoise * random.normal();
        label.data_ptr<int64_t>()[r] = static_cast<int64_t>(c);
      }
      const torch::Tensor out = networks_[n].forward(x, {}, &random);
      networks_[n].learn(torch::nn::functional::cross_entropy(out, label));
    }
    networks_[n].freeze();
  };
  parallel_for(settings_.networks, work);
}

torch::Tensor Classifier::loss(const torch::Tensor& windows, const torch::Tensor& wanted,
                               float smoothing, Random& random) const {
  const auto repeated = [](const std::vector<float>& numbers) {
    return torch::tensor(numbers).repeat({kClassifiedPoses});
  };
  const torch::Tensor normalised = (windows - repeated(units_.mean)) / repeated(units_.scale);
  torch::Tensor noise = torch::empty_like(normalised, torch::TensorOptions().requires_grad(false));
  float* number = noise.data_ptr<float>();
  for (int64_t i = 0; i < noise.numel(); ++i) number[i] = kNoise * random.normal();
  const torch::Tensor seen = normalised + noise;
  torch::Tensor sum = torch::zeros({});
  for (const NetworkTrainer& network : networks_) {
    sum = sum + torch::nn::functional::cross_entropy(
                    network.forward(seen, {}, &random), wanted,
                    torch::nn::functional::CrossEntropyFuncOptions().label_smoothing(smoothing));
  }
  return sum / static_cast<double>(networks_.size());
}

Classification Classifier::classify(const Take& take) const {
  torch::NoGradGuard no_gradients;
  const int span = (kClassifiedPoses - 1) * kClassifiedSpacing;
  const int count = 1 + std::max(0, take.frames() - 1 - span) / kClassifiedHop;
  const torch::Tensor x = torch::empty({count, kClassifiedInputs});
  for (int w = 0; w < count; ++w) {
    const std::span window(x.data_ptr<float>() + size_t(w) * kClassifiedInputs, kClassifiedInputs);
    copy_window(take, w * kClassifiedHop, window);
    normalise(window);
  }
  Classification classified{torch::zeros({count, static_cast<int64_t>(classes_.size())}), {}};
  for (const NetworkTrainer& network : networks_) {
    classified.probabilities +=
        torch::softmax(network.forward(x, {}, nullptr), 1) / settings_.networks;
  }
  classified.features = networks_.front().hidden(x, nullptr);
  return classified;
}

}  // namespace panache
