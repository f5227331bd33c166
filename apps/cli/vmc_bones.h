#pragma once
// The bones that VMC messages speak of: those of Unity's humanoid, each relative to the nearest of
// its ancestors that the sender has.

#include <bitset>
#include <optional>
#include <span>
#include <string_view>

#include "clip/clip.h"

namespace panache::cli {

// The root first, then the bones, parents before children.
inline constexpr int kVmcBones = 56;
inline constexpr int kVmcRoot = 0, kVmcHips = 1;

// "LeftUpperArm"; the root is called "root".
std::string_view vmc_bone_name(int bone);
// The bone of a /VMC/Ext/Bone/Pos message, never the root.
std::optional<int> find_vmc_bone(std::string_view name);

using VmcBoneSet = std::bitset<kVmcBones>;

// A skeleton of these bones and the root, in their order, whose offsets are `positions`
// [kVmcBones] (metres, Panache's axes). At rest it stands in the T-pose; the root and the hips
// move, all joints turn.
Skeleton vmc_skeleton(const VmcBoneSet& bones, std::span<const Vec3> positions);

}  // namespace panache::cli
