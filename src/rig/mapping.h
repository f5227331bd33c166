#pragma once
// Maps the joints of a skeleton to the humanoid. Hands, feet, toes and head are found by name, the
// rest by the hierarchy between them; if names do not decide, the shape of the skeleton does.

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
  std::array<std::string, kHumanJoints> reasons;  // How it was found, for display.
  std::array<float, kHumanJoints> confidence{};   // 0 (a guess, or missing) to 1 (certain).
  std::vector<std::string> notes;                 // Oddities, for the user.
};

// Given skeleton joints of human joints; -1 if the skeleton has none.
using KnownJoints = std::map<int, int>;

// poses: the skeleton in a few poses of its motion or at rest, at least one, in any axes and units.
// The mapping has hips, upper and lower parts of all limbs, and feet. Fails with a message that
// lists the missing joints and the skeleton's, or says why `known` is impossible.
Result<Mapping> map_humanoid(const Skeleton& skeleton, std::span<const JointPositions> poses,
                             const KnownJoints& known = {});

// Exchanges left and right of arms, legs or both in `mapping` where toes, knees and path show that
// the body faces the other way, as in a mirrored armature or with names that exchange the sides, or
// where the arms are on the other side than the legs. Then adds a note to `notes`. Sides of joints
// in `known` stay.
void take_sides_of_body(const Clip& clip, const KnownJoints& known, Mapping& mapping,
                        std::vector<std::string>& notes);

}  // namespace panache
