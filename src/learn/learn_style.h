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

// An instant of the styled clip and the matching one of the neutral clip.
struct MatchedInstant {
  double styled_seconds, neutral_seconds;  // After the first frame of each take.
  double distance;                         // See PairReport::match; of the window around it.
};

// How well a pair matched.
struct PairReport {
  std::string neutral_name, styled_name;
  double seconds = 0;  // Of the styled clip.
  double tempo = 1;    // Neutral seconds per styled second, the mean.
  double match = 0;    // Mean squared distance of matched frames, in deviations: 0 is equal.
  // Warnings with their cures, as sentences.
  std::vector<std::string> warnings;
  std::optional<TwinFacts> twin = {};    // If it was learnt without a neutral clip.
  std::vector<MatchedInstant> instants;  // For each matched styled frame, in order.
};

// A gesture that is stored with a style, and where it was found.
struct LearntGesture {
  std::string name;               // See Gesture::name().
  std::string take;               // The name of the styled clip.
  double start = 0, seconds = 0;  // Start in the clip, after its first frame, and duration.
};

struct LearntStyle {
  TensorFile file;  // A style file, see style_file.h.
  std::vector<PairReport> pairs;
  std::vector<LearntGesture> gestures;  // Strongest first, see find_gestures().
  // Mean joint distances (cm on the canonical body) over the last quarters of the styled clips, for
  // a style learnt without these: of the style, of its mean posture alone, and of the unchanged
  // neutral motion. 0, and `judged` false, if the clips are too short.
  bool judged = false;
  double held_back_cm = 0, mean_posture_cm = 0, untouched_cm = 0;
  // Based on these distances: "good"; "fair" if the style removes little of the distance, or its
  // mean posture alone removes more; "poor" if it is no better than the unchanged neutral motion;
  // "" if it was not evaluated.
  const char* verdict() const;
  // For the style as a whole, like PairReport::warnings: if its verdict is "poor".
  std::vector<std::string> warnings;
};

// The message for a model without a trunk for learning styles.
Error cannot_learn(const std::string& name);

// Learns the style called `style` on the activations of a model file, which must be able to learn
// and is not changed; `name` is the model's, for messages. The same input gives the same bytes.
Result<LearntStyle> learn_style(const TensorFile& model, const std::string& name,
                                std::span<const LearnPair> pairs, const std::string& style,
                                const std::string& description);

}  // namespace panache
