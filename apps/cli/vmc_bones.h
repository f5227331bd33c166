#pragma once
// The bones of VMC messages: Unity's humanoid, each relative to its nearest ancestor that the
// sender has.

#include <array>
#include <bitset>
#include <optional>
#include <span>
#include <string_view>

#include "clip/clip.h"

namespace panache::cli {

// The root first, then the bones, parents before children.
inline constexpr int kVmcBones = 56;
inline constexpr int kVmcRoot = 0, kVmcHips = 1;

// "LeftUpperArm"; "root" for the root.
std::string_view vmc_bone_name(int bone);
// The bone named in a /VMC/Ext/Bone/Pos message; never the root.
std::optional<int> find_vmc_bone(std::string_view name);

using VmcBoneSet = std::bitset<kVmcBones>;

// A skeleton of the root and these bones, in their order, with `positions` as offsets: [kVmcBones],
// metres, Panache's axes. Its rest pose is the T-pose; the root and hips can move, all joints can
// rotate.
Skeleton vmc_skeleton(const VmcBoneSet& bones, std::span<const Vec3> positions);

// Their positions in the canonical body, for a sender that gives none: those of fingers and eyes
// are 0.
std::array<Vec3, kVmcBones> usual_positions(const VmcBoneSet& bones);

}  // namespace panache::cli
