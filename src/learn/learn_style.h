#pragma once
// A new style from a few seconds of motion: from clips to a style file.

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/result.h"
#include "clip/clip.h"
#include "learn/take.h"
#include "net/safetensors.h"
#include "rig/rig.h"
#include "walker/walker_model.h"

namespace panache {

// A clip to learn from.
struct LearnClip {
  const Clip& clip;
  const Rig& rig;
  std::string name;  // Of its file, for messages.
};

// An action done neutrally and in the style, on the canonical body.
struct LearnPair {
  std::string neutral_name, styled_name;
  Take neutral, styled;
};

// Rejects what is no action that a neutral of our own is made for: they are "walk" and "run".
Result<void> check_action(const std::string& action);

// Both clips are of one skeleton: joints of the same names in the same tree (what is above the
// hips may have any), resting in the same directions, of any length. Clips of other skeletons are
// rejected, and those too short to learn from.
Result<LearnPair> make_learn_pair(const LearnClip& neutral, const LearnClip& styled);
// With a neutral of our own making in place of a recorded one: the walker's, see check_action().
// What tells the walker's body and gait from the performer's becomes part of the style,
// and the turn of a limb about its own axis is not learnt.
Result<LearnPair> make_learn_pair(const LearnClip& styled, const std::string& action,
                                  std::shared_ptr<const WalkerModel> walker);

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
  const char* judgement() const;  // Of `match`: "good", "fair" or "poor".
  // What about it may spoil the style, and the cure. Sentences.
  std::vector<std::string> warnings;
  std::vector<MatchedInstant> instants;  // Of each styled frame that was laid somewhere, in order.
};

struct LearntStyle {
  TensorFile file;  // A style file, see style_file.h.
  std::vector<PairReport> pairs;
  // Mean distance of the joints (cm on the canonical body) over the last quarters of the styled
  // clips when the style was learnt without them: of the style, of its mean posture alone, and of
  // the neutral motion as it is. 0 where the clips are too short for it: `judged` tells.
  bool judged = false;
  double held_back_cm = 0, mean_posture_cm = 0, untouched_cm = 0;
};

// The message for a model without a trunk that styles can be learnt on.
Error cannot_learn(const std::string& name);

// Learns the style called `style` on the activations of a model file, which can learn and stays as
// it is; `name` is its own, for messages. The same input gives the same bytes.
Result<LearntStyle> learn_style(const TensorFile& model, const std::string& name,
                                std::span<const LearnPair> pairs, const std::string& style,
                                const std::string& description);

}  // namespace panache
