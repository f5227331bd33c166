#include "style/model/predictor_network.h"

#include <algorithm>
#include <array>
#include <tuple>
#include <cassert>
#include <cmath>

#include "net/dense.h"

namespace panache {
namespace {

// Deviations from the mean, the limit in training.
constexpr float kInputClip = 3;

}  // namespace

bool PredictorNetwork::is_in(const TensorFile& file) {
  const auto found = file.tensors.lower_bound("predict.");
  return found != file.tensors.end() && found->first.starts_with("predict.");
}

Result<PredictorNetwork> PredictorNetwork::read(const TensorFile& file, const std::string& name) {
  PredictorNetwork out;
  for (const auto& [key, rows, to] :
       {std::tuple{"predict.mean", 1, &out.mean_}, std::tuple{"predict.scale", 1, &out.scale_},
        std::tuple{"predict.linear", kWindowPoses - 1, &out.linear_}}) {
    Result<std::vector<float>> read = read_vector(file, key, rows * kFeatures, name);
    if (!read) return read.error();
    *to = *std::move(read);
  }
  if (std::any_of(out.scale_.begin(), out.scale_.end(), [](float s) { return s <= 0; })) {
    return Error{name + ": tensor 'predict.scale' must be above zero throughout"};
  }
  Result<Trunk> trunk = Trunk::read(file, "predict.trunk", kWindowPoses * kFeatures, name);
  if (!trunk) return trunk.error();
  if (trunk->scratch_size() > kMaxScratch) {
    return Error{name + ": the layers of 'predict.trunk' have " +
                 std::to_string(trunk->scratch_size()) + " units; expected at most " +
                 std::to_string(kMaxScratch)};
  }
  Result<DenseLayer> head = read_layer(file, "predict.head.0", trunk->outputs(), kFeatures, name);
  if (!head) return head.error();
  out.trunk_ = *std::move(trunk);
  out.head_ = *std::move(head);
  return out;
}

void PredictorNetwork::next(std::span<const float> window,
                            std::span<float, kFeatures> out) const noexcept {
  assert(window.size() == size_t{kWindowPoses * kFeatures});
  // The newest pose, then the changes that led to it, newest first.
  std::array<float, size_t{kWindowPoses * kFeatures}> input;
  float squares = 0;
  for (size_t n = 0; n < kFeatures; ++n) {
    input[n] = std::clamp((window[n] - mean_[n]) / scale_[n], -kInputClip, kInputClip);
  }
  for (size_t i = kFeatures; i < input.size(); ++i) {
    input[i] = (window[i - kFeatures] - window[i]) * unit(i % kFeatures);
    squares += input[i] * input[i];
  }
  const float changes = static_cast<float>(input.size() - kFeatures);
  const float motion = std::max(std::sqrt(squares / changes), kMinMotion);
  for (size_t i = kFeatures; i < input.size(); ++i) input[i] /= motion;

  std::array<float, kMaxScratch> scratch;
  dense(trunk_.forward(input, scratch), head_.weights, head_.bias, out);
  for (size_t n = 0; n < kFeatures; ++n) {
    float sum = window[n] + motion * out[n];
    for (size_t k = 0; k + 1 < kWindowPoses; ++k) {
      const size_t at = k * kFeatures + n;
      sum += linear_[at] * (window[at] - window[at + kFeatures]);
    }
    out[n] = sum;
  }
}

PredictedPose PredictorNetwork::predict(std::span<const float> window, const RootPose& now,
                                        double seconds) const noexcept {
  constexpr int kSteps = 5;
  static_assert(kSteps * kWindowSpacing >= kMaxSeconds);
  std::array<float, size_t{kWindowPoses * kFeatures}> seen;
  std::array<float, size_t{kFeatures}> pose;
  std::copy(window.begin(), window.end(), seen.begin());
  PredictedPose earlier{read_positions(window), now}, later = earlier;
  const double steps = std::clamp(seconds, 0.0, kMaxSeconds) / kWindowSpacing;
  const int whole = std::min(static_cast<int>(std::ceil(steps)), kSteps);
  for (int step = 0; step < whole; ++step) {
    next(seen, pose);
    std::copy_backward(seen.begin(), seen.end() - kFeatures, seen.end());
    std::copy(pose.begin(), pose.end(), seen.begin());
    earlier = later;
    later = {read_positions(pose),
             move_root(later.root, std::span(pose).last<kRootFeatures>(), kWindowSpacing)};
  }
  const float t = whole == 0 ? 1.0f : static_cast<float>(steps - (whole - 1));
  PredictedPose out;
  for (size_t j = 0; j < out.body.size(); ++j) {
    out.body[j] = lerp(earlier.body[j], later.body[j], t);
  }
  out.root = interpolate(earlier.root, later.root, t);
  return out;
}

}  // namespace panache
