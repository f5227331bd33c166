#pragma once
// Which joint of a skeleton is which of the humanoid: names find hands, feet, toes and head, the
// tree between them finds the rest. Another way to find them (by shape, say) is another function
// with the same result.

#include <array>
#include <span>
#include <string>
#include <vector>

#include "base/result.h"
#include "clip/clip.h"
#include "rig/humanoid.h"

namespace panache {

struct Mapping {
  std::array<int, kHumanJoints> joint_of;         // Skeleton joint, or -1. No two are the same.
  std::array<std::string, kHumanJoints> reasons;  // How it was found, for people.
  std::array<float, kHumanJoints> confidence{};   // 0 (a guess, or missing) to 1 (certain).
  std::vector<std::string> notes;                 // What a careful user would want to know.
};

// positions[joints]: where the joints are in some ordinary pose of the motion, in any axes and
// units. Fails with a sentence that names the joints that were not found and those that were seen.
Result<Mapping> map_by_names(const Skeleton& skeleton, std::span<const Vec3> positions);

}  // namespace panache
