#pragma once
// Pairs for learning a style: one action, performed neutrally and in the style.

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

}  // namespace panache
