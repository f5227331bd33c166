#pragma once
// Recognises a motion that is on the character's own skeleton already. Private to the folder.

#include <optional>
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

}  // namespace panache
