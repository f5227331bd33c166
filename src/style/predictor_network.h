#pragma once
// The network that predicts input. A style that is faster than its input asks for input that has
// not arrived yet; "predicting input poses" is what the slides of Smith et al. 2019 call it.

#include <span>
#include <string>
#include <vector>

#include "base/result.h"
#include "net/mlp.h"
#include "pose/features.h"

namespace panache {

// A body some time from now.
struct PredictedPose {
  HumanPositions body;  // In its own body frame, metres.
  RootPose root;
};

// A small network from a window (layout positions) to the pose 0.05 s after it. Each number is
// continued by itself from its last changes, linearly; the network adds what they cannot know, in
// proportion to how much the body moves, so that slow motion is predicted as finely as it moves.
// Read-only; part of a model.
class PredictorNetwork {
 public:
  static constexpr int kFeatures = pose_feature_count(PoseLayout::positions);
  // Times that predict() may be asked for, seconds. Beyond, nothing was trained.
  static constexpr double kMaxSeconds = 0.25;

  // Whether the model file has one.
  static bool is_in(const TensorFile& file);
  static Result<PredictorNetwork> read(const TensorFile& file, const std::string& name);

  // The weight of each number's change relative to a position's.
  static constexpr float unit(size_t number) {
    constexpr size_t kRoot = root_offset(PoseLayout::positions);
    return number < kRoot ? 1.0f : number < kRoot + kTurnRate ? 0.05f : 0.025f;
  }
  // Changes are seen in proportion to their root mean square, but not to less than this, metres.
  static constexpr float kMinMotion = 3e-4f;

  // Writes the numbers of the pose 0.05 s after the newest of `window`.
  // window[kWindowPoses][kFeatures], newest first; out[kFeatures], no part of it.
  void next(std::span<const float> window, std::span<float, kFeatures> out) const noexcept;

  // The body `seconds` (0 to kMaxSeconds) after the newest pose of `window`, which is on `now`.
  PredictedPose predict(std::span<const float> window, const RootPose& now,
                        double seconds) const noexcept;

 private:
  static constexpr size_t kMaxScratch = 1024;

  std::vector<float> mean_, scale_;  // [kFeatures], of a pose.
  std::vector<float> linear_;        // [kWindowPoses - 1][kFeatures]: shares of the last changes.
  Trunk trunk_;
  DenseLayer head_;
};

}  // namespace panache
