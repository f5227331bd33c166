#pragma once
// The network that foresees input. A style that is faster than its input asks for input that has
// not arrived yet; "predicting input poses" is what the slides of Smith et al. 2019 call it.

#include <span>
#include <string>
#include <vector>

#include "base/result.h"
#include "net/mlp.h"
#include "pose/features.h"

namespace panache {

// A body some time from now.
struct ForeseenBody {
  HumanPositions body;  // In its own body frame, metres.
  Ground ground;
};

// A small network from a window (layout positions) to the pose 0.05 s after it. Each number is
// continued by itself from its last changes, linearly; the network adds what they cannot know, in
// proportion to how much the body moves, so that slow motion is foreseen as finely as it moves.
// Read-only; part of a model.
class Predictor {
 public:
  static constexpr int kNumbers = pose_numbers(PoseLayout::positions);
  // Times that foresee() may be asked for, seconds. Beyond, nothing was trained.
  static constexpr double kMostSeconds = 0.25;

  // Whether the model file has one.
  static bool is_in(const TensorFile& file);
  static Result<Predictor> read(const TensorFile& file, const std::string& name);

  // What a change of each number weighs against that of a position.
  static constexpr float unit(size_t number) {
    constexpr size_t kRoot = root_offset(PoseLayout::positions);
    return number < kRoot ? 1.0f : number < kRoot + kTurnRate ? 0.05f : 0.025f;
  }
  // Changes are seen in proportion to their root mean square, but not to less than this, metres.
  static constexpr float kLeastMotion = 3e-4f;

  // Writes the numbers of the pose 0.05 s after the newest of `window`.
  // window[kWindowPoses][kNumbers], newest first; out[kNumbers], no part of it.
  void next(std::span<const float> window, std::span<float, kNumbers> out) const noexcept;

  // The body `seconds` (0 to kMostSeconds) after the newest pose of `window`, which is on `now`.
  ForeseenBody foresee(std::span<const float> window, const Ground& now,
                       double seconds) const noexcept;

 private:
  static constexpr size_t kMaxScratch = 1024;

  std::vector<float> mean_, scale_;  // [kNumbers], of a pose.
  std::vector<float> linear_;        // [kWindowPoses - 1][kNumbers]: shares of the last changes.
  Trunk trunk_;
  DenseLayer head_;
};

}  // namespace panache
