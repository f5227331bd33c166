#include "vmc_bones.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <string>
#include <utility>
#include <vector>

#include "rig/canonical_body.h"

namespace panache::cli {
namespace {

struct Bone {
  std::string name;
  int parent;
};

std::vector<Bone> all_bones() {
  std::vector<Bone> bones = {
      {"root", -1},          {"Hips", 0},       {"Spine", 1},         {"Chest", 2},
      {"UpperChest", 3},     {"Neck", 4},       {"Head", 5},          {"LeftEye", 6},
      {"RightEye", 6},       {"Jaw", 6},        {"LeftShoulder", 4},  {"LeftUpperArm", 10},
      {"LeftLowerArm", 11},  {"LeftHand", 12},  {"RightShoulder", 4}, {"RightUpperArm", 14},
      {"RightLowerArm", 15}, {"RightHand", 16}, {"LeftUpperLeg", 1},  {"LeftLowerLeg", 18},
      {"LeftFoot", 19},      {"LeftToes", 20},  {"RightUpperLeg", 1}, {"RightLowerLeg", 22},
      {"RightFoot", 23},     {"RightToes", 24},
  };
  for (const auto& [side, hand] : {std::pair("Left", 13), std::pair("Right", 17)}) {
    for (const char* finger : {"Thumb", "Index", "Middle", "Ring", "Little"}) {
      int parent = hand;
      for (const char* part : {"Proximal", "Intermediate", "Distal"}) {
        bones.push_back({std::string(side) + finger + part, parent});
        parent = static_cast<int>(bones.size()) - 1;
      }
    }
  }
  return bones;
}

const std::vector<Bone> kBones = all_bones();  // [kVmcBones]

// VRM's name of the bone: Unity's with a lower-case first letter.
std::string role_of(int bone) {
  std::string role = kBones[bone].name;
  role[0] = static_cast<char>(role[0] - 'A' + 'a');
  return role;
}

}  // namespace

std::string_view vmc_bone_name(int bone) {
  assert(bone >= 0 && bone < kVmcBones);
  return kBones[bone].name;
}

std::optional<int> find_vmc_bone(std::string_view name) {
  for (int b = kVmcHips; b < kVmcBones; ++b) {
    if (kBones[b].name == name) return b;
  }
  return std::nullopt;
}

std::array<Vec3, kVmcBones> usual_positions(const VmcBoneSet& bones) {
  const Skeleton usual = canonical_skeleton();
  std::array<Vec3, kVmcBones> out{}, passed{};  // Passed: of bones that the sender lacks.
  for (int b = kVmcHips; b < kVmcBones; ++b) {
    const auto joint = std::ranges::find(usual.joints, role_of(b), &Joint::name);
    const Vec3 offset = joint == usual.joints.end() ? Vec3{} : joint->offset;
    const int parent = kBones[b].parent;
    const Vec3 whole = offset + (bones[static_cast<size_t>(parent)] ? Vec3{} : passed[parent]);
    (bones[static_cast<size_t>(b)] ? out : passed)[b] = whole;
  }
  return out;
}

Skeleton vmc_skeleton(const VmcBoneSet& bones, std::span<const Vec3> positions) {
  assert(positions.size() == kVmcBones);
  Skeleton out;
  std::array<int, kVmcBones> joint_of{};
  for (int b = 0; b < kVmcBones; ++b) {
    if (b != kVmcRoot && !bones[b]) {
      joint_of[b] = joint_of[kBones[b].parent];  // Used as the parent of its children.
      continue;
    }
    Joint joint;
    joint.name = kBones[b].name;
    joint.parent = b == kVmcRoot ? -1 : joint_of[kBones[b].parent];
    joint.offset = positions[b];
    joint.can_rotate = true;
    joint.can_translate = b == kVmcRoot || b == kVmcHips;
    if (b != kVmcRoot) joint.role = role_of(b);
    joint_of[b] = static_cast<int>(out.joints.size());
    out.joints.push_back(std::move(joint));
  }
  return out;
}

}  // namespace panache::cli
