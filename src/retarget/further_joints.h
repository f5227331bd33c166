#pragma once
// Joints beyond the humanoid that two rigs have in common: fingers, and those that spread a twist
// over the skin.

#include <string>
#include <utility>
#include <vector>

#include "clip/clip.h"
#include "rig/rig.h"

namespace panache {

// A joint of each rig, below the same human joint.
struct JointPair {
  int from = 0, onto = 0;  // Joints of the skeletons.
  int human = 0;           // The nearest human joint above both.
};

// Fingers by their names, wherever both rigs say which finger a joint belongs to, in order from the
// hand; twist joints where both have as many of them below the same human joint. In the order of
// the joints of `onto`.
std::vector<JointPair> find_further_joints(const Skeleton& from, const Rig& from_rig,
                                           const Skeleton& onto, const Rig& onto_rig);

// The fingers that the rig has, as pairs of the human joint of the hand and "thumb", "index",
// "middle", "ring" or "little".
std::vector<std::pair<int, std::string>> find_fingers(const Skeleton& skeleton, const Rig& rig);

}  // namespace panache
