#pragma once
// Some joints of a skeleton, perhaps in another tree than the file's, as a skeleton of its own for
// the mapping. Private to the folder.

#include <span>
#include <vector>

#include "base/result.h"
#include "clip/clip.h"
#include "rig/joint_tree.h"
#include "rig/mapping.h"

namespace panache {

// parents[joints]: each joint's parent in the subset, of any index, without cycles; joints for
// which `taken` is 0 are left out, and their children hang on the nearest joint above that is not.
struct JointSubset {
  JointSubset(const Skeleton& skeleton, std::span<const int> parents, std::span<const char> taken);

  bool has(int joint) const;  // An index in the whole skeleton.
  // The same joints of whole poses.
  std::vector<JointPositions> poses_of(std::span<const JointPositions> whole) const;
  // map_humanoid() for the subset, in indices of the whole skeleton. Joints that are `known`
  // outside the subset are rejected.
  Result<Mapping> map(std::span<const JointPositions> whole, const KnownJoints& known) const;

  Skeleton skeleton;
  std::vector<int> original;  // [joints of the subset]: index in the whole skeleton.
};

}  // namespace panache
