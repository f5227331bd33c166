#pragma once
// A new style from a few seconds of motion: from clips to a style file.

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/result.h"
#include "clip/clip.h"
#include "learn/neutral_bank.h"
#include "learn/take.h"
#include "net/safetensors.h"
#include "rig/rig.h"

namespace panache {

// A clip to learn from.
struct LearnClip {
  const Clip& clip;
  const Rig& rig;
  std::string name;  // The file's name, for messages.
};

// An action performed neutrally and in the style, or a neutral and a styled pose, on the canonical
// body.
struct LearnPair {
  std::string neutral_name, styled_name;
  Take neutral, styled;
  bool is_pose = false;
  int neutral_cycle = 0;  // Frames, if the neutral clip is one cycle; see cycle_frames().
  std::optional<TwinFacts> twin = {};  // If the neutral motion is not from a clip.
};

// Two clips of one frame are a pair of poses. Both skeletons must have the same human joints.
// Unless all their joints have the same names, parents and directions at rest, in any order and
// apart from joints above the hips, the styled motion is retargeted to the neutral skeleton. Other
// skeletons are rejected, and so are clips that are too short to learn from.
Result<LearnPair> make_learn_pair(const LearnClip& neutral, const LearnClip& styled);
// Without a neutral clip: uses what people in the bank do instead. Twist, the rotation of a limb
// about its own axis, is not learnt. A single pose is handled by make_pose_pair().
Result<LearnPair> make_learn_pair(const LearnClip& styled, const NeutralBank& bank);

// A styled pose, the only frame of the clip, paired with a body that stands upright with its arms
// down. Twist, the rotation of a limb about its own axis, is not learnt.
Result<LearnPair> make_pose_pair(const LearnClip& styled);

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
