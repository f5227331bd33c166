#pragma once
// The network that predicts input. A style that is faster than its input needs input that has not
// arrived yet ("predicting input poses" in the slides of Smith et al. 2019).

#include <span>
#include <string>
#include <vector>

#include "base/result.h"
#include "net/mlp.h"
#include "pose/features.h"

namespace panache {

// A predicted pose.
struct PredictedPose {
  HumanPositions body;  // In its own body frame, metres.
  RootPose root;
};

// A small network from a window (layout positions) to the pose 0.05 s after it. Each feature is
// extrapolated linearly from its last changes; the network adds a correction, scaled by how much
// the body moves, so that slow motion is predicted with proportionate precision. Read-only; part of
// a model.
class PredictorNetwork {
 public:
  static constexpr int kFeatures = pose_feature_count(PoseLayout::positions);
  // The largest time for predict(), seconds: the limit of the training.
  static constexpr double kMaxSeconds = 0.25;

  // Whether the model file has one.
  static bool is_in(const TensorFile& file);
  static Result<PredictorNetwork> read(const TensorFile& file, const std::string& name);

  // The weight of each number's change relative to a position's.
  static constexpr float unit(size_t number) {
    constexpr size_t kRoot = root_offset(PoseLayout::positions);
    return number < kRoot ? 1.0f : number < kRoot + kTurnRate ? 0.05f : 0.025f;
  }
  // Changes are normalised by their root mean square, but at least by this, metres.
  static constexpr float kMinMotion = 3e-4f;

  // Writes the features of the pose 0.05 s after the newest of `window`.
  // window[kWindowPoses][kFeatures], newest first; out[kFeatures] must not overlap it.
  void next(std::span<const float> window, std::span<float, kFeatures> out) const noexcept;

  // The body `seconds` (0 to kMaxSeconds) after the newest pose of `window`, whose root is `now`.
  PredictedPose predict(std::span<const float> window, const RootPose& now,
                        double seconds) const noexcept;

 private:
  static constexpr size_t kMaxScratch = 1024;

  std::vector<float> mean_, scale_;  // [kFeatures], of a pose.
  std::vector<float> linear_;        // [kWindowPoses - 1][kFeatures]: weights of the last changes.
  Trunk trunk_;
  DenseLayer head_;
};

}  // namespace panache
