#pragma once
// Pairs to learn a style from: one action, done neutrally and in the style.

#include <optional>
#include <string>

#include "base/result.h"
#include "clip/clip.h"
#include "learn/neutral_bank.h"
#include "learn/take.h"
#include "rig/rig.h"

namespace panache {

// A clip to learn from.
struct LearnClip {
  const Clip& clip;
  const Rig& rig;
  std::string name;  // Of its file, for messages.
};

// An action done neutrally and in the style, or a neutral pose and one in the style, on the
// canonical body.
struct LearnPair {
  std::string neutral_name, styled_name;
  Take neutral, styled;
  bool is_pose = false;
  int neutral_cycle = 0;  // Frames, where the neutral clip is one cycle; see cycle_frames().
  std::optional<TwinFacts> twin = {};  // Where the neutral motion is not a clip's.
};

// Clips of one frame each are a pair of poses. Both skeletons have joints of the same names with
// the same parents, in any order; what is above the hips may differ. Where their rest poses differ,
// the styled motion is put on the neutral skeleton; bone lengths may always differ. Other skeletons
// are rejected, and so are clips that are too short to learn from.
Result<LearnPair> make_learn_pair(const LearnClip& neutral, const LearnClip& styled);
// Without a neutral clip: what people in the bank do in its place. The turn of a limb about its own
// axis is not learnt. A pose is as of make_pose_pair().
Result<LearnPair> make_learn_pair(const LearnClip& styled, const NeutralBank& bank);

// A pose in the style, the only frame of the clip, beside a body that stands upright with hanging
// arms. The turn of a limb about its own axis is not learnt.
Result<LearnPair> make_pose_pair(const LearnClip& styled);

}  // namespace panache
