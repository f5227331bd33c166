#include "style/stages/foot_stance.h"

#include <gtest/gtest.h>

#include "make_clip.h"
#include "pose/changed_joints.h"
#include "rig/posed_rig.h"

namespace panache {
namespace {

// A body of which the left knee, the hips and the toes are this high, with a style that lowers the
// hips from a frame on; how far it is to be lifted again after a second.
struct Heights {
  float knee = 0.5f, hips = 0.9f, toes = 0;
};
float lift(const Heights& heights, float lowered, float carried = 1, int from = 0) {
  const Clip clip = test::walking_clip(1);
  PosedRig rig(*Rig::create(clip));
  BodyPose body;
  rig.read(clip.pose(0), body);
  const auto put = [&](HumanJoint joint, float height) { body.joints[index(joint)].y = height; };
  put(HumanJoint::left_lower_leg, heights.knee);
  put(HumanJoint::right_lower_leg, 0.5f);
  put(HumanJoint::hips, heights.hips);
  put(HumanJoint::left_toes, heights.toes);
  put(HumanJoint::right_toes, heights.toes);
  FloorClearance floor;
  float lifted = 0;
  for (int f = 0; f < 60; ++f) {
    BodyChange change;
    const float down = f < from ? 0 : lowered;
    change.translation.y = -down;
    HumanPositions joints;
    changed_joints(body, change, joints);
    lifted = floor.step(body, joints, 1, carried, 0, {1 / 60.0, 1 / 60.0f, f == 0}, change);
  }
  return lifted;
}

TEST(FloorClearance, lifts_a_body_whose_toes_are_in_the_floor) {
  EXPECT_NEAR(lift({}, 0.03f), 0.03f, 1e-3f);
  EXPECT_EQ(lift({}, 0), 0);
}

TEST(FloorClearance, lifts_a_body_that_kneels_or_sits_deeper_than_its_input) {
  EXPECT_NEAR(lift({.knee = 0.04f, .toes = 0.1f}, 0.06f), 0.06f, 1e-3f);
  EXPECT_NEAR(lift({.hips = 0.1f, .toes = 0.1f}, 0.05f), 0.03f, 1e-3f) << "8 cm is where hips rest";
  EXPECT_NEAR(lift({.knee = 0.3f, .toes = 0.1f}, 0.06f), 0, 1e-3f) << "a knee in the air may sink";
}

TEST(FloorClearance, lowers_a_body_that_hovers_unless_something_else_carries_it) {
  EXPECT_NEAR(lift({}, -0.08f), -0.08f, 1e-3f);
  EXPECT_NEAR(lift({}, -0.08f, 1, 48), -0.015f, 0.01f) << "a hop stays one";
  EXPECT_EQ(lift({}, -0.08f, 0), 0);
}

}  // namespace
}  // namespace panache
