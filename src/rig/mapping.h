#pragma once
// Which joint of a skeleton is which of the humanoid. Names find hands, feet, toes and head, the
// tree between them finds the rest; where names do not decide, the shape of the skeleton does.

#include <array>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "base/result.h"
#include "clip/clip.h"
#include "rig/humanoid.h"
#include "rig/joint_tree.h"

namespace panache {

struct Mapping {
  std::array<int, kHumanJoints> joint_of;         // Skeleton joint, or -1. No two are the same.
  std::array<std::string, kHumanJoints> reasons;  // How it was found, for people.
  std::array<float, kHumanJoints> confidence{};   // 0 (a guess, or missing) to 1 (certain).
  std::vector<std::string> notes;                 // Oddities, for the user.
};

// Skeleton joints that are known beforehand for human joints; -1 where the skeleton has none.
using KnownJoints = std::map<int, int>;

// poses: the skeleton in a few poses of its motion or at rest, at least one, in any axes and units.
// The mapping has hips, upper and lower parts of all limbs, and feet. Fails with a message that
// names the joints that were not found and those that were seen, or that says why what is known
// cannot be.
Result<Mapping> map_humanoid(const Skeleton& skeleton, std::span<const JointPositions> poses,
                             const KnownJoints& known = {});

}  // namespace panache
