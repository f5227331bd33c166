#pragma once
// Training data: windows of neutral motion, and the style's change for each.

#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <vector>

#include "learn/pairing.h"
#include "learn/take.h"
#include "recipes/recipe.h"

namespace panache {

// The frames dropped at each end of a warped window, which depend on what lies beyond it.
inline constexpr int kTrimFrames = 4;

// The tempo of a pairing, neutral seconds per styled second, clamped to a plausible range.
constexpr float believable_rate(float rate) { return std::clamp(rate, 0.33f, 3.0f); }

// One training sample. The window is cut from the neutral take when it is needed.
struct Sample {
  int take = 0;                       // The neutral take,
  float frame = 0;                    // and where in it the window ends.
  int style = 0;                      // Index in the model; -1 is neutral itself.
  int styled = -1;                    // The styled take it was paired with; -1 for neutral itself,
  int styled_frame = 0;               // and the frame of it.
  float log_rate = 0;                 // Logarithm of neutral seconds per styled second.
  std::array<float, kFeet> contacts;  // Of the styled frame: 0 or 1.
  bool has_next = false;              // The next sample is the next frame of the same window.
};

// Normalisation of pose features: subtract the mean, divide by the scale, which is their deviation
// with a lower limit. [pose_feature_count(layout)]
struct InputUnits {
  std::vector<float> mean, scale;
};
// Measured on all frames of takes[which], both as they are and mirrored.
InputUnits input_units(const std::vector<Take>& takes, const std::vector<int>& which,
                       PoseLayout layout);

class SampleSet {
 public:
  // Samples of the pairings, and of the neutral takes themselves if `with_neutral`. `styles`: names
  // in the model's order.
  SampleSet(const std::vector<Take>& takes, const std::vector<Pairing>& pairings,
            const std::vector<std::string>& styles, const Recipe& recipe, bool with_neutral);

  const Recipe& recipe() const { return recipe_; }
  int numbers() const { return pose_feature_count(recipe_.layout); }  // Per pose.
  int inputs() const { return kWindowPoses * numbers(); }
  int outputs() const { return recipe_.outputs; }
  const std::vector<Sample>& samples() const { return samples_; }
  Sample& sample(size_t i) { return samples_[i]; }
  // The target of the pose network for sample i, in the model's units. [outputs]
  std::span<const float> target(size_t i) const {
    return {&targets_[i * outputs()], static_cast<size_t>(outputs())};
  }
  std::span<float> target(size_t i) {
    return {&targets_[i * outputs()], static_cast<size_t>(outputs())};
  }
  // Measured on the neutral takes.
  const InputUnits& units() const { return units_; }
  const std::vector<float>& mean() const { return units_.mean; }
  const std::vector<float>& scale() const { return units_.scale; }

  // The action in a sample.
  const std::string& content(const Sample& sample) const { return takes_[sample.take].row.content; }

  // Writes the window of sample i, played `tempo` times as fast. [inputs]
  void window(size_t i, std::span<float> out, float tempo = 1) const;

 private:
  void add_pairing(const Pairing& pairing, int style);
  void add_neutral(int take);
  void add_target(const Take& styled, int frame, const Take& neutral, float at, float rate);

  const std::vector<Take>& takes_;
  const Recipe& recipe_;
  std::vector<Sample> samples_;
  std::vector<float> targets_;
  InputUnits units_;
};

// The change from the neutral take at frame `at` to frame `frame` of the styled one, at `rate`
// neutral seconds per styled second.
StyleDelta change_between(const Take& styled, int frame, const Take& neutral, float at, float rate);

// The body and the root activations of a take at a fractional frame, straight between its frames.
HumanPositions body_at(const Take& take, float frame);
std::array<float, kRootFeatures> root_at(const Take& take, float frame);

// Writes the window of a take that ends at `frame`, its poses `spacing` frames apart.
// [kWindowPoses * numbers]
void take_window(const Take& take, float frame, int numbers, std::span<float> out,
                 float spacing = static_cast<float>(kWindowSpacing * kTakeRate));

}  // namespace panache
