#include "rig/humanoid.h"

namespace panache {
namespace {

constexpr std::array<std::string_view, kHumanJoints> kNames = {
    "hips",          "spine",         "chest",         "neck",          "head",
    "leftShoulder",  "leftUpperArm",  "leftLowerArm",  "leftHand",      "rightShoulder",
    "rightUpperArm", "rightLowerArm", "rightHand",     "leftUpperLeg",  "leftLowerLeg",
    "leftFoot",      "leftToes",      "rightUpperLeg", "rightLowerLeg", "rightFoot",
    "rightToes"};

constexpr bool mirror_is_its_own_inverse() {
  for (int j = 0; j < kHumanJoints; ++j) {
    if (kHumanMirror[kHumanMirror[j]] != j) return false;
    const int parent = kHumanParent[j];
    const int other = kHumanParent[kHumanMirror[j]];
    if (parent < 0 ? other >= 0 : other != kHumanMirror[parent]) return false;
  }
  return true;
}
static_assert(mirror_is_its_own_inverse());

}  // namespace

// A generic body in round numbers, so that models do not depend on any data set's figures. Adult
// proportions, legs of 0.8 m; narrow shoulders and short collar bones, so that a rig without collar
// bones loses little. The distances of torso joints, collar bones and hip joints follow from the
// values below.
constinit const Proportions kProportions = {
    // hips, spine, chest, neck, head; then shoulder, upper arm, lower arm, hand of either side;
    // then upper leg, lower leg, foot, toes of either side.
    {0,     0.148f, 0.105f,  0.1831f, 0.065f, 0.1556f, 0.0559f, 0.25f, 0.22f, 0.1556f, 0.0559f,
     0.25f, 0.22f,  0.0825f, 0.4f,    0.4f,   0.12f,   0.0825f, 0.4f,  0.4f,  0.12f},
    0.8f,
    0.42f,
    0.4f,
    0.65f,
    0.08f,
    0.105f,
    {0, -0.02f, 0},
    {0, 0.035f, 0.02f},
    {0.05f, 0, 0.01f},
    {-0.05f, 0, 0.01f},
    0.6f};

std::string_view human_joint_name(int joint) {
  return joint >= 0 && joint < kHumanJoints ? kNames[joint] : std::string_view{};
}

std::optional<int> find_human_joint(std::string_view vrm_name) {
  for (int j = 0; j < kHumanJoints; ++j) {
    if (kNames[j] == vrm_name) return j;
  }
  return std::nullopt;
}

HumanPositions mirrored(const HumanPositions& positions) {
  HumanPositions out;
  for (int j = 0; j < kHumanJoints; ++j) {
    const Vec3 p = positions[kHumanMirror[j]];
    out[j] = {-p.x, p.y, p.z};
  }
  return out;
}

}  // namespace panache
