#include "rig/canonical_skeleton.h"

#include <cmath>
#include <string>

#include "rig/canonical_body.h"

namespace panache {
namespace {

using enum HumanJoint;

// Lengths beyond the last joints: to skull, finger tips and toe tips.
constexpr float kHeadLength = 0.20f;
constexpr float kHandLength = 0.17f;
constexpr float kToeLength = 0.06f;

// Offsets from the parent in T-pose.
HumanPositions rest_offsets() noexcept {
  const float slope = kProportions.toe_pitch;
  HumanPositions out;
  const auto at = [&](HumanJoint joint) -> Vec3& { return out[index(joint)]; };
  const auto length_of = [&](HumanJoint joint) { return kProportions.length[index(joint)]; };
  const Vec3 toes = Vec3{0, -sine(slope), cosine(slope)} * length_of(left_toes);
  at(hips) = {0, kProportions.leg - toes.y - kProportions.hips_to_mid_hip.y, 0};
  at(spine) =
      kProportions.hips_to_mid_hip + Vec3{0, kProportions.torso * kProportions.spine_fraction, 0};
  at(chest) = {0, kProportions.torso * (kProportions.chest_fraction - kProportions.spine_fraction),
               0};
  const Vec3 mid_shoulder = {0, kProportions.torso * (1 - kProportions.chest_fraction), 0};
  at(neck) = mid_shoulder + kProportions.mid_shoulder_to_neck;
  at(head) = {0, length_of(head), 0};
  at(left_shoulder) = mid_shoulder + kProportions.mid_shoulder_to_left_shoulder;
  at(left_upper_arm) =
      Vec3{kProportions.half_shoulders, 0, 0} - kProportions.mid_shoulder_to_left_shoulder;
  at(left_lower_arm) = {length_of(left_lower_arm), 0, 0};
  at(left_hand) = {length_of(left_hand), 0, 0};
  at(left_upper_leg) = kProportions.hips_to_mid_hip + Vec3{kProportions.half_hips, 0, 0};
  at(left_lower_leg) = {0, -length_of(left_lower_leg), 0};
  at(left_foot) = {0, -length_of(left_foot), 0};
  at(left_toes) = toes;
  for (int j = 0; j < kHumanJoints; ++j) {
    if (kHumanMirror[j] > j) out[kHumanMirror[j]] = {-out[j].x, out[j].y, out[j].z};
  }
  return out;
}

// Initialised before main(): canonical_frames() must not block.
const HumanPositions kRestOffsets = rest_offsets();

// The child that a joint points at; -1 for the ends, and for hips and chest, which point at
// several.
constexpr std::array<int, kHumanJoints> kPointsAt = {-1, 2,  -1, 4,  -1, 6,  7,  8,  -1, 10, 11,
                                                     12, -1, 14, 15, 16, -1, 18, 19, 20, -1};

Quat nearest_sign(Quat q, Quat to) { return dot(q, to) < 0 ? Quat{-q.x, -q.y, -q.z, -q.w} : q; }

Quat frame_rotation(Vec3 left, Vec3 up, Quat otherwise) {
  if (!(length(cross(left, up)) > 1e-6f)) return otherwise;
  const Frame frame = frame_of(left, up);
  return nearest_sign(from_axes(frame.x, frame.y, frame.z), otherwise);
}

}  // namespace

Skeleton canonical_skeleton() {
  Skeleton out;
  for (int j = 0; j < kHumanJoints; ++j) {
    Joint joint;
    joint.name = std::string(human_joint_name(j));
    joint.parent = kHumanParent[j];
    joint.offset = kRestOffsets[j];
    joint.can_rotate = true;
    joint.can_translate = j == index(hips);
    out.joints.push_back(std::move(joint));
  }
  const auto end = [&](HumanJoint joint, Vec3 tip) { out.joints[index(joint)].ends = {tip}; };
  end(head, {0, kHeadLength, 0});
  end(left_hand, {kHandLength, 0, 0});
  end(right_hand, {-kHandLength, 0, 0});
  end(left_toes, {0, 0, kToeLength});
  end(right_toes, {0, 0, kToeLength});
  return out;
}

void canonical_frames(const HumanPositions& positions, float facing,
                      std::array<Quat, kHumanJoints>& world) noexcept {
  const auto at = [&](HumanJoint joint) { return positions[index(joint)]; };
  for (int j = 0; j < kHumanJoints; ++j) {
    const Quat parent = j ? world[kHumanParent[j]] : rotation_y(facing);
    world[j] = parent;
    if (j == index(hips)) {
      world[j] =
          frame_rotation(at(left_upper_leg) - at(right_upper_leg), at(spine) - at(hips), parent);
    } else if (j == index(chest)) {
      const Vec3 shoulders = (at(left_upper_arm) + at(right_upper_arm)) * 0.5f;
      world[j] =
          frame_rotation(at(left_upper_arm) - at(right_upper_arm), shoulders - at(chest), parent);
    } else if (const int child = kPointsAt[j]; child >= 0) {
      const Vec3 rest = rotate(parent, normalized(kRestOffsets[child]));
      const Vec3 now = normalized(positions[child] - positions[j], rest);
      world[j] = rotation_between(rest, now) * parent;
    }
  }
}

}  // namespace panache
