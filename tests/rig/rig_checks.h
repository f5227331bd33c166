#pragma once
// What must hold of every rig and every pose, made up or captured.

#include <gtest/gtest.h>

#include <array>
#include <random>
#include <vector>

#include "rig/made_up.h"
#include "rig/posed_rig.h"

namespace panache::test {

// The clip's rig, which has to be recognised.
inline Rig rig_of(const Clip& clip) {
  Result<Rig> rig = Rig::create(clip);
  if (!rig) ADD_FAILURE() << rig.error().message;
  return *std::move(rig);
}

// Why the clip has no rig; "" if it has one.
inline std::string rejection_of(const Clip& clip, const RigOptions& options = {}) {
  const Result<Rig> rig = Rig::create(clip, options);
  return rig ? "" : rig.error().message;
}

// Room for one pose.
struct PoseBuffer {
  explicit PoseBuffer(size_t joints) : rotations(joints), translations(joints) {}
  Pose pose() { return {rotations, translations}; }
  std::vector<Quat> rotations;
  std::vector<Vec3> translations;
};

inline BodyChange random_change(std::mt19937& random) {
  std::uniform_real_distribution<float> any(-1, 1);
  BodyChange change;
  for (Quat& q : change.rotations) q = random_rotation(random, 1.0f);
  change.turn = any(random);
  change.translation = {any(random), any(random), any(random)};
  return change;
}

// Joints whose direction from their parent is the user's own on the canonical body.
inline constexpr std::array kLimbs = {HumanJoint::left_lower_arm,  HumanJoint::left_hand,
                                      HumanJoint::right_lower_arm, HumanJoint::right_hand,
                                      HumanJoint::left_lower_leg,  HumanJoint::left_foot,
                                      HumanJoint::right_lower_leg, HumanJoint::right_foot};

inline Vec3 limb(const HumanPositions& body, HumanJoint joint) {
  return body[index(joint)] - body[kHumanParent[index(joint)]];
}
inline Vec3 mid_hip(const HumanPositions& body) {
  return (body[index(HumanJoint::left_upper_leg)] + body[index(HumanJoint::right_upper_leg)]) *
         0.5f;
}

// Limbs keep their directions, and have canonical lengths.
inline void expect_canonical(const BodyPose& body) {
  for (HumanJoint joint : kLimbs) {
    const Vec3 got = limb(body.positions, joint);
    EXPECT_LT(angle_deg(got, limb(body.joints, joint)), 1e-3) << human_joint_name(index(joint));
    EXPECT_NEAR(length(got), kProportions.length[index(joint)], 2e-6f);
  }
  for (HumanJoint joint : {HumanJoint::head, HumanJoint::left_toes, HumanJoint::right_toes}) {
    EXPECT_NEAR(length(limb(body.positions, joint)), kProportions.length[index(joint)], 2e-6f);
  }
  EXPECT_LT(length(mid_hip(body.positions) - mid_hip(body.joints)), 5e-6f);
}

// Without a change, the pose comes back bit for bit; `out` is scratch.
inline bool unchanged(PosedRig& rig, ConstPose in, Pose out) {
  BodyPose body;
  rig.read(in, body);
  rig.write(in, body, BodyChange{}, out);
  for (size_t j = 0; j < in.rotations.size(); ++j) {
    if (!same_bits(in.rotations[j], out.rotations[j])) return false;
    if (!same_bits(in.translations[j], out.translations[j])) return false;
  }
  return true;
}

struct Deviation {
  double limb_deg = 0;      // Of limb directions from what the change asks for.
  double rotation_deg = 0;  // Of world rotations.
  double mid_hip = 0;       // Of mid-hip from input plus translation, metres.
};

// Writes `change` and compares, in double, with what it must do to the body.
inline Deviation deviation(PosedRig& rig, const Clip& clip, ConstPose in, const BodyChange& change,
                           Pose out) {
  RotatedBodyPose before, after;
  rig.read(in, before);
  rig.write(in, before, change, out);
  rig.read(out, after);
  const Quatd turn = rotation_y<double>(change.turn);
  const Quatd heading = rotation_y<double>(before.facing);
  std::array<Quatd, kHumanJoints> delta;
  for (int j = 0; j < kHumanJoints; ++j) {
    const int joint = rig.rig().joints()[j];
    const bool rotates = joint >= 0 && clip.skeleton.joints[joint].can_rotate;
    const Quatd own = change.rotations[j].as<double>();
    delta[j] = rotates ? turn * heading * own * conjugate(heading) : delta[kHumanParent[j]];
  }
  Deviation worst;
  for (HumanJoint joint : kLimbs) {
    const Quatd above = delta[kHumanParent[index(joint)]];
    const Vec3 want = rotate(above, limb(before.joints, joint).as<double>()).as<float>();
    worst.limb_deg = std::max(worst.limb_deg, angle_deg(limb(after.joints, joint), want));
  }
  for (int j = 0; j < kHumanJoints; ++j) {
    const Quatd want = delta[j] * before.rotations[j].as<double>();
    const Quatd off = conjugate(want) * after.rotations[j].as<double>();
    const double angle = length(log_rotation(off)) * 180 / 3.14159265358979323846;
    worst.rotation_deg = std::max(worst.rotation_deg, angle);
  }
  worst.mid_hip = length((mid_hip(after.joints) - mid_hip(before.joints) - change.translation));
  return worst;
}

}  // namespace panache::test
