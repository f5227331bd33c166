#pragma once
// Joints beyond the humanoid that two rigs have in common: fingers and twist joints.

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

// Fingers by their names, if both rigs name the finger, in order from the hand; twist joints if
// both rigs have the same number below the same human joint. In the order of `onto`'s joints.
std::vector<JointPair> find_further_joints(const Skeleton& from, const Rig& from_rig,
                                           const Skeleton& onto, const Rig& onto_rig);

// The rig's fingers, as pairs of the hand's human joint and "thumb", "index", "middle", "ring" or
// "little".
std::vector<std::pair<int, std::string>> find_fingers(const Skeleton& skeleton, const Rig& rig);

}  // namespace panache
