#include "vmc_bones.h"

#include <algorithm>
#include <array>
#include <cassert>

namespace panache::cli {
namespace {

struct Bone {
  std::string_view name;
  int parent;
};

constexpr std::array<Bone, kVmcBones> kBones = {{
    {"root", -1},
    {"Hips", 0},
    {"Spine", 1},
    {"Chest", 2},
    {"UpperChest", 3},
    {"Neck", 4},
    {"Head", 5},
    {"LeftEye", 6},
    {"RightEye", 6},
    {"Jaw", 6},
    {"LeftShoulder", 4},
    {"LeftUpperArm", 10},
    {"LeftLowerArm", 11},
    {"LeftHand", 12},
    {"RightShoulder", 4},
    {"RightUpperArm", 14},
    {"RightLowerArm", 15},
    {"RightHand", 16},
    {"LeftUpperLeg", 1},
    {"LeftLowerLeg", 18},
    {"LeftFoot", 19},
    {"LeftToes", 20},
    {"RightUpperLeg", 1},
    {"RightLowerLeg", 22},
    {"RightFoot", 23},
    {"RightToes", 24},
    {"LeftThumbProximal", 13},
    {"LeftThumbIntermediate", 26},
    {"LeftThumbDistal", 27},
    {"LeftIndexProximal", 13},
    {"LeftIndexIntermediate", 29},
    {"LeftIndexDistal", 30},
    {"LeftMiddleProximal", 13},
    {"LeftMiddleIntermediate", 32},
    {"LeftMiddleDistal", 33},
    {"LeftRingProximal", 13},
    {"LeftRingIntermediate", 35},
    {"LeftRingDistal", 36},
    {"LeftLittleProximal", 13},
    {"LeftLittleIntermediate", 38},
    {"LeftLittleDistal", 39},
    {"RightThumbProximal", 17},
    {"RightThumbIntermediate", 41},
    {"RightThumbDistal", 42},
    {"RightIndexProximal", 17},
    {"RightIndexIntermediate", 44},
    {"RightIndexDistal", 45},
    {"RightMiddleProximal", 17},
    {"RightMiddleIntermediate", 47},
    {"RightMiddleDistal", 48},
    {"RightRingProximal", 17},
    {"RightRingIntermediate", 50},
    {"RightRingDistal", 51},
    {"RightLittleProximal", 17},
    {"RightLittleIntermediate", 53},
    {"RightLittleDistal", 54},
}};

constexpr bool parents_come_first() {
  for (int b = 1; b < kVmcBones; ++b) {
    if (kBones[b].parent < 0 || kBones[b].parent >= b) return false;
  }
  return true;
}
static_assert(parents_come_first());

// VRM's name of the bone: Unity's with a small first letter.
std::string role_of(int bone) {
  std::string role(kBones[bone].name);
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

Skeleton vmc_skeleton(const VmcBoneSet& bones, std::span<const Vec3> positions) {
  assert(positions.size() == kVmcBones);
  Skeleton out;
  std::array<int, kVmcBones> joint_of{};
  for (int b = 0; b < kVmcBones; ++b) {
    if (b != kVmcRoot && !bones[b]) {
      joint_of[b] = joint_of[kBones[b].parent];  // Of what hangs on it.
      continue;
    }
    Joint joint;
    joint.name = std::string(kBones[b].name);
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
