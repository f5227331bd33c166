#pragma once
// Pairs to learn a style from: one action, done neutrally and in the style.

#include <memory>
#include <string>

#include "base/result.h"
#include "clip/clip.h"
#include "learn/take.h"
#include "rig/rig.h"
#include "walker/walker_model.h"

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
};

// Fails unless `action` is "walk" or "run", for which the walker makes the neutral motion.
Result<void> check_action(const std::string& action);

// Clips of one frame each are a pair of poses. Both skeletons have joints of the same names with
// the same parents, in any order; what is above the hips may differ. Where their rest poses differ,
// the styled motion is put on the neutral skeleton; bone lengths may always differ. Other skeletons
// are rejected, and so are clips that are too short to learn from.
Result<LearnPair> make_learn_pair(const LearnClip& neutral, const LearnClip& styled);
// With a neutral of our own making in place of a recorded one: the walker's, see check_action().
// The difference between the walker's body and gait and the performer's becomes part of the style,
// and the turn of a limb about its own axis is not learnt.
Result<LearnPair> make_learn_pair(const LearnClip& styled, const std::string& action,
                                  std::shared_ptr<const WalkerModel> walker);

// A pose in the style, the only frame of the clip, beside a body that stands upright with hanging
// arms. The turn of a limb about its own axis is not learnt.
Result<LearnPair> make_pose_pair(const LearnClip& styled);

}  // namespace panache
