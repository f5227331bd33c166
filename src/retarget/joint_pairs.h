#pragma once
// Joints that two skeletons have in common: all of them, if a motion is on the character's own
// skeleton already, or fingers and twist joints. Private to the folder.

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "clip/clip.h"
#include "rig/rig.h"

namespace panache {

// How the joints of one skeleton are those of another, whose local rotations mean the same.
struct SameSkeleton {
  std::vector<int>
      from;         // [joints of the character]: the motion's joint; -1: it rests, above the roots.
  float scale = 1;  // Units of the character for one of the motion.
};

// Nothing if a joint of the character hangs, rests or is named differently in the motion, or is not
// in it, except for joints above the roots, such as the node that a converter puts there.
std::optional<SameSkeleton> find_same_skeleton(const Skeleton& from, const Rig& from_rig,
                                               const Skeleton& onto, const Rig& onto_rig);

// The pose of the motion on the character's joints.
void copy_pose(const SameSkeleton& same, const Skeleton& onto, ConstPose from, Pose out);

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
