#include "style/play/pose_predictor.h"

#include <algorithm>
#include <cmath>

#include "base/quat.h"

namespace panache {
namespace {

// Until predictions are checked, the network has the largest weight. Metres.
constexpr std::array<float, 4> kFirstErrors = {0.02f, 0.04f, 0.06f, 0.06f};
// The share of a new error in the mean: four checks a second, so half is forgotten in a second.
constexpr float kErrorGain = 0.16f;
// Time constant at which weights change, so that nothing jumps.
constexpr float kWeightSeconds = 0.2f;
// Later checks do not count: frames were dropped.
constexpr double kLatest = 0.05;  // Seconds.

}  // namespace

PosePredictor::PosePredictor(std::shared_ptr<const Model> model)
    : model_(std::move(model)), history_(PoseLayout::positions) {
  reset();
}

void PosePredictor::reset() noexcept {
  time_ = predicted_at_ = 0;
  history_.clear();
  newest_ = {}, predictions_ = {};
  errors_.fill(kFirstErrors);
  weights_.fill(weights_of(kFirstErrors));
  checked_ = kChecks.size();
}

void PosePredictor::push(double time, const HumanPositions& body, const RootPose& root) noexcept {
  history_.push(time, body, root);
  const float gain = 1 - exponential(static_cast<float>(time_ - time) / kWeightSeconds);
  for (size_t c = 0; c < kChecks.size(); ++c) {
    const PerExpert wanted = weights_of(errors_[c]);
    for (size_t g = 0; g < kExperts; ++g) weights_[c][g] += gain * (wanted[g] - weights_[c][g]);
  }
  time_ = time;
  newest_ = {body, root};
  while (checked_ < kChecks.size() && time >= predicted_at_ + kChecks[checked_]) {
    if (time < predicted_at_ + kChecks[checked_] + kLatest) check(checked_, body, root);
    ++checked_;
  }
  if (checked_ < kChecks.size()) return;
  for (size_t c = 0; c < kChecks.size(); ++c) predictions_[c] = ask_experts(kChecks[c]);
  predicted_at_ = time;
  checked_ = 0;
}

void PosePredictor::check(size_t at, const HumanPositions& body, const RootPose& root) noexcept {
  const HumanPositions truth = to_world(body, root);
  for (size_t g = 0; g < kExperts; ++g) {
    const HumanPositions predicted = to_world(predictions_[at][g].body, predictions_[at][g].root);
    float sum = 0;
    for (size_t j = 0; j < truth.size(); ++j) sum += length(predicted[j] - truth[j]);
    const float error = sum / static_cast<float>(truth.size());
    if (std::isfinite(error)) errors_[at][g] += kErrorGain * (error - errors_[at][g]);
  }
}

PosePredictor::Predictions PosePredictor::ask_experts(double seconds) const noexcept {
  constexpr size_t kFeatures = PredictorNetwork::kFeatures;
  std::array<float, kWindowPoses * kFeatures> window;
  history_.window(window);
  const auto pose = [&](size_t k) {
    return std::span<const float, kFeatures>(&window[k * kFeatures], kFeatures);
  };
  const HumanPositions before = read_positions(pose(1)), earlier = read_positions(pose(2));
  const RootPose root = move_root(newest_.root, pose(0).last<kRootFeatures>(), seconds);
  PredictedPose velocity{newest_.body, root}, acceleration = velocity;
  const auto steps = static_cast<float>(seconds / kWindowSpacing);
  for (size_t j = 0; j < velocity.body.size(); ++j) {
    const Vec3 change = newest_.body[j] - before[j], last = before[j] - earlier[j];
    velocity.body[j] += change * steps;
    acceleration.body[j] = velocity.body[j] + (change - last) * (steps * (steps + 1) / 2);
  }
  return {model_->predictor()->predict(window, newest_.root, seconds), velocity, acceleration,
          newest_};
}

// Fourth power: twice the error gives one sixteenth of the weight.
PosePredictor::PerExpert PosePredictor::weights_of(const PerExpert& errors) noexcept {
  constexpr float kNothing = 1e-5f;  // Metres.
  const float min = *std::min_element(errors.begin(), errors.end()) + kNothing;
  PerExpert weights;
  float total = 0;
  for (size_t g = 0; g < kExperts; ++g) {
    const float ratio = min / (errors[g] + kNothing);
    total += weights[g] = ratio * ratio * ratio * ratio;
  }
  for (float& share : weights) share /= total;
  return weights;
}

PredictedPose PosePredictor::predict(double seconds) const noexcept {
  if (seconds <= 0) return newest_;
  const Predictions predictions = ask_experts(seconds);
  // The share of the later check.
  const auto later =
      static_cast<float>(std::clamp((seconds - kChecks[0]) / (kChecks[1] - kChecks[0]), 0.0, 1.0));
  // Adds each prediction, by its weight.
  PredictedPose out = newest_;
  for (size_t g = 0; g < kExperts; ++g) {
    const float share = (1 - later) * weights_[0][g] + later * weights_[1][g];
    for (size_t j = 0; j < out.body.size(); ++j) {
      out.body[j] += (predictions[g].body[j] - newest_.body[j]) * share;
    }
    out.root.position += (predictions[g].root.position - newest_.root.position) * share;
    out.root.facing += (predictions[g].root.facing - newest_.root.facing) * share;
  }
  return out;
}

}  // namespace panache
