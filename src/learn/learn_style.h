#pragma once
// A new style from a few seconds of motion: from clips to a style file.

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/result.h"
#include "learn/learn_pair.h"
#include "net/safetensors.h"

namespace panache {

// An instant of the styled clip and the one of the neutral clip that it goes together with.
struct MatchedInstant {
  double styled_seconds, neutral_seconds;  // After the first frame of each take.
  double distance;                         // As PairReport::match, of the window around it.
};

// How well a pair went together.
struct PairReport {
  std::string neutral_name, styled_name;
  double seconds = 0;  // Of the styled clip.
  double tempo = 1;    // Neutral seconds per styled second, the mean.
  double match = 0;  // Mean squared distance of what was laid together, in deviations: 0 is equal.
  // Warnings, with their cure. Sentences.
  std::vector<std::string> warnings;
  std::optional<TwinFacts> twin = {};    // Where it was learnt without a neutral clip.
  std::vector<MatchedInstant> instants;  // Of each styled frame that was laid somewhere, in order.
};

// A gesture that is kept with a style, and where it was found.
struct LearntGesture {
  std::string name;               // See Gesture::name().
  std::string take;               // The name of the styled clip.
  double start = 0, seconds = 0;  // In the clip, after its first frame, and for how long.
};

struct LearntStyle {
  TensorFile file;  // A style file, see style_file.h.
  std::vector<PairReport> pairs;
  std::vector<LearntGesture> gestures;  // The strongest first, see find_gestures().
  // Mean distance of the joints (cm on the canonical body) over the last quarters of the styled
  // clips when the style was learnt without them: of the style, of its mean posture alone, and of
  // the neutral motion as it is. 0 where the clips are too short for it: `judged` tells.
  bool judged = false;
  double held_back_cm = 0, mean_posture_cm = 0, untouched_cm = 0;
  // By these distances: "good"; "fair" where the style removes little of the distance or its mean
  // posture alone removes more; "poor" where it is no better than the neutral motion as it is; ""
  // where it was not judged.
  const char* verdict() const;
  // Of the style as a whole, as PairReport::warnings: where its verdict is "poor".
  std::vector<std::string> warnings;
};

// The message for a model without a trunk that styles can be learnt on.
Error cannot_learn(const std::string& name);

// Learns the style called `style` on the activations of a model file, which can learn and stays as
// it is; `name` is its own, for messages. The same input gives the same bytes.
Result<LearntStyle> learn_style(const TensorFile& model, const std::string& name,
                                std::span<const LearnPair> pairs, const std::string& style,
                                const std::string& description);

}  // namespace panache
