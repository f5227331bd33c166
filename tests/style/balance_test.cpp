#include "style/stages/lean.h"

#include <gtest/gtest.h>

#include "make_clip.h"
#include "rig/posed_rig.h"

namespace panache {
namespace {

struct Leant {
  float before, after;  // How far the change moves the body's centre ahead, metres.
  bool same;            // Whether keep_balance() left the change alone, to the bit.
};

// A standing body whose upper body a style leans ahead.
Leant lean(float radians) {
  const Clip clip = test::walking_clip(1);
  PosedRig rig(*Rig::create(clip));
  BodyPose read;
  rig.read(clip.pose(0), read);
  const HeadingBody body = read;
  BodyChange change;
  for (int j = 0; j <= index(HumanJoint::right_hand); ++j) {
    change.rotations[j] = axis_angle(Vec3{1, 0, 0}, radians);
  }
  const BodyChange asked = change;
  HumanPositions joints;
  const float own = rotate(body.to_heading, centre_over_feet(body.joints)).z;
  changed_joints(body, change, joints);
  const float before = centre_over_feet(joints).z - own;
  keep_balance(body, 1, joints, change);
  return {before, centre_over_feet(joints).z - own, change.rotations == asked.rotations};
}

TEST(Balance, a_style_that_leans_far_is_turned_back_in_part) {
  const Leant far = lean(1.3f);
  EXPECT_GT(far.before, 0.14f);
  EXPECT_LT(far.after, 0.125f);
  EXPECT_GT(far.after, 0.1f);
  EXPECT_FALSE(far.same);
}

TEST(Balance, a_style_that_moves_the_centre_by_less_than_8_cm_is_left_alone) {
  const Leant little = lean(0.4f);
  EXPECT_GT(little.before, 0.05f);
  EXPECT_LT(little.before, 0.08f);
  EXPECT_TRUE(little.same);
}

}  // namespace
}  // namespace panache
