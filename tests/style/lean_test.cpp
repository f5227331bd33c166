// How far a style may bend a body: it neither folds nor falls.

#include "style/stages/lean.h"

#include <cmath>

#include <gtest/gtest.h>

#include "make_clip.h"
#include "pose/changed_joints.h"
#include "rig/posed_rig.h"

namespace panache {
namespace {

constexpr float kPerDegree = 3.14159265f / 180;  // Radians.

BodyPose upright_body() {
  const Clip clip = test::walking_clip(1);
  PosedRig rig(*Rig::create(clip));
  BodyPose body;
  rig.read(clip.pose(0), body);
  return body;
}

float lean(const HumanPositions& joints) {
  using enum HumanJoint;
  const Vec3 torso = joints[index(left_upper_arm)] + joints[index(right_upper_arm)] -
                     joints[index(left_upper_leg)] - joints[index(right_upper_leg)];
  return std::atan2(std::hypot(torso.x, torso.z), torso.y) / kPerDegree;
}

// Turns the upper body of `joints` forward about the hips.
void bend(float degrees, HumanPositions& joints) {
  const Quat turn = axis_angle(Vec3{1, 0, 0}, degrees * kPerDegree);
  const Vec3 hips =
      (joints[index(HumanJoint::left_upper_leg)] + joints[index(HumanJoint::right_upper_leg)]) *
      0.5f;
  for (int j = index(HumanJoint::spine); j <= index(HumanJoint::right_hand); ++j) {
    joints[j] = hips + rotate(turn, joints[j] - hips);
  }
}

// A style that leans the upper body ahead.
BodyChange leant_by(float degrees) {
  BodyChange change;
  for (int j = 0; j <= index(HumanJoint::right_hand); ++j) {
    change.rotations[j] = axis_angle(Vec3{1, 0, 0}, degrees * kPerDegree);
  }
  return change;
}

// The lean of a body that leans by `input` degrees already, in a style that adds `added`.
float styled(float input, float added) {
  BodyPose body = upright_body();
  bend(input - lean(body.joints), body.joints);
  BodyChange change = leant_by(added);
  HumanPositions joints;
  changed_joints(body, change, joints);
  limit_fold(body, 1, joints, change);
  HumanPositions again;
  changed_joints(body, change, again);
  EXPECT_EQ(joints[index(HumanJoint::head)], again[index(HumanJoint::head)]);
  return lean(joints);
}

TEST(Fold, a_bent_style_does_not_fold_a_body_that_bends_down) {
  EXPECT_NEAR(styled(5, 30), 35, 0.5f) << "an old walk stays as it is";
  EXPECT_NEAR(styled(5, 75), 80, 0.5f) << "and so does one that is bent double";
  EXPECT_LT(styled(45, 40), 70);
  EXPECT_NEAR(styled(85, 30), 85, 0.5f) << "no further than the input itself";
  EXPECT_NEAR(styled(80, -30), 50, 0.5f) << "a style that rights the body is left alone";
  float last = 0;
  for (float input = 0; input < 90; input += 2) {
    const float now = styled(input, 40);
    if (input > 0) {
      EXPECT_LT(std::abs(now - last), 2.5f) << input;
    }
    last = now;
  }
}

TEST(Fold, a_body_near_the_floor_keeps_its_own_pose) {
  HumanPositions world = upright_body().joints;
  EXPECT_EQ(share_above_floor(world), 1);
  world[index(HumanJoint::head)].y = 0.25f;
  EXPECT_EQ(share_above_floor(world), 0);
  world[index(HumanJoint::head)].y = 0.375f;
  EXPECT_NEAR(share_above_floor(world), 0.5f, 1e-3f);
}

TEST(Balance, a_lean_stops_before_the_body_falls_and_a_small_one_is_left_alone) {
  using enum HumanJoint;
  const BodyPose body = upright_body();
  const auto moved = [&](const BodyChange& change) {
    HumanPositions joints, before;
    changed_joints(body, change, joints);
    changed_joints(body, {}, before);
    Vec3 centre, feet;
    for (int j = 0; j < kHumanJoints; ++j) centre += (joints[j] - before[j]) / 21.0f;
    for (const HumanJoint j : {left_foot, left_toes, right_foot, right_toes}) {
      feet += (joints[index(j)] - before[index(j)]) / 4.0f;
    }
    return std::hypot(centre.x - feet.x, centre.z - feet.z);
  };
  for (int degrees = 0; degrees <= 75; degrees += 5) {
    SCOPED_TRACE(degrees);
    const BodyChange asked = leant_by(static_cast<float>(degrees));
    BodyChange change = asked;
    HumanPositions joints, kept_up;
    changed_joints(body, change, joints);
    keep_balance(body, 1, joints, change);
    EXPECT_LE(moved(change), moved(asked) + 1e-6f);  // Rounding.
    EXPECT_LT(moved(change), 0.135f);
    if (moved(asked) > 0.14f) {
      EXPECT_GT(moved(change), 0.1f);
    }
    if (moved(asked) < 0.08f) {
      EXPECT_EQ(change.rotations, asked.rotations);
    }
    // The upper body turns as one.
    const Quat turn = change.rotations[0] * conjugate(asked.rotations[0]);
    for (int j = index(hips); j <= index(right_hand); ++j) {
      const Quat wanted = turn * asked.rotations[j];
      EXPECT_NEAR(std::abs(dot(change.rotations[j], wanted)), 1, 1e-6f) << human_joint_name(j);
    }
    EXPECT_EQ(change.rotations[index(left_upper_leg)], Quat{});
    changed_joints(body, change, kept_up);
    EXPECT_EQ(joints, kept_up);
  }
}

}  // namespace
}  // namespace panache
