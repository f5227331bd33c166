#include "style/stages/foot_stance.h"

#include <cmath>

#include <gtest/gtest.h>

#include "make_clip.h"
#include "pose/changed_joints.h"
#include "rig/posed_rig.h"

namespace panache {
namespace {

constexpr Vec3 kSide{1, 0, 0};

// A body that stands, in a style that folds its left leg, lifts and turns its left foot, and moves
// its hips.
class Standing : public ::testing::Test {
 protected:
  Standing() : clip_(test::walking_clip(1)), rig_(*Rig::create(clip_)) {
    rig_.read(clip_.pose(0), body_);
    for (int f = 0; f < kFeet; ++f) {
      const float x = body_.joints[index(kUpperLegs[f])].x;
      const float hips = body_.joints[index(kUpperLegs[f])].y;
      body_.joints[index(kLowerLegs[f])] = {x, hips / 2, 0.02f};
      body_.joints[index(kAnkles[f])] = {x, 0.08f, 0};
      body_.joints[index(kToes[f])] = {x, 0.02f, 0.13f};
    }
  }

  BodyChange asked() const {
    BodyChange change;
    change.rotations[index(HumanJoint::left_upper_leg)] = axis_angle(kSide, -fold_);
    change.rotations[index(HumanJoint::left_lower_leg)] = axis_angle(kSide, fold_);
    change.rotations[index(HumanJoint::left_foot)] = rotation_y(turn_) * axis_angle(kSide, heel_);
    change.translation.y = hips_;
    return change;
  }
  // After `seconds`. The input's left foot moves at `speed`, m/s.
  void run(double seconds, float stepping = 0, float speed = 0) {
    constexpr float kTick = 1 / 60.0f;
    for (int f = 0; f < seconds * 60; ++f) {
      body_.joints[index(HumanJoint::left_foot)].z += speed * kTick;
      body_.joints[index(HumanJoint::left_toes)].z += speed * kTick;
      change_ = asked();
      changed_joints(body_, change_, joints_);
      stage_.step(body_, joints_, stance_, 1, stepping, lift_, raised_, 0, {kTick, kTick, first_},
                  change_);
      first_ = false;
    }
    changed_joints(body_, change_, joints_);
  }
  float above_input(HumanJoint joint) const {
    const float origin = mid_hip(body_).y + change_.translation.y;
    return origin + joints_[index(joint)].y - body_.joints[index(joint)].y;
  }
  // Of the left foot about +y, radians.
  float turned() const {
    const Quat turn = change_.rotations[index(HumanJoint::left_foot)];
    return 2 * std::atan2(turn.y, turn.w);
  }

  Clip clip_;
  PosedRig rig_;
  BodyPose body_;
  Stance stance_;
  float fold_ = 0.5f, heel_ = 0, turn_ = 0, hips_ = 0, lift_ = 0, raised_ = 0;
  FootStance stage_;
  bool first_ = true;
  BodyChange change_;
  HumanPositions joints_;
};

TEST_F(Standing, a_foot_that_hangs_comes_down_with_heel_and_toe) {
  heel_ = 0.4f;
  run(1);
  EXPECT_NEAR(above_input(HumanJoint::left_foot), 0, 2e-3f);
  EXPECT_NEAR(above_input(HumanJoint::left_toes), 0, 2e-3f);
}

TEST_F(Standing, a_hop_takes_the_feet_with_it) {
  heel_ = 0.4f;
  lift_ = hips_ = 0.1f;
  run(1);
  EXPECT_NEAR(above_input(HumanJoint::left_foot), lift_, 2e-3f);
  EXPECT_NEAR(above_input(HumanJoint::left_toes), lift_, 2e-3f);
}

TEST_F(Standing, hips_come_down_where_the_leg_is_too_short) {
  fold_ = 0;
  hips_ = 0.1f;
  run(1);
  EXPECT_NEAR(above_input(HumanJoint::left_toes), 0, 3e-3f);
  EXPECT_NEAR(above_input(HumanJoint::right_toes), 0, 3e-3f);
  EXPECT_LT(change_.translation.y, 0.02f);
}

TEST_F(Standing, what_the_floor_asks_of_the_hips_is_eased_and_the_feet_stay) {
  run(0.1);
  raised_ = -0.06f;
  float last = change_.translation.y;
  for (int f = 0; f < 60; ++f) {
    run(1 / 60.0);
    EXPECT_LE(change_.translation.y, last) << f;
    EXPECT_GT(change_.translation.y, last - 0.01f) << f;
    EXPECT_NEAR(above_input(HumanJoint::left_toes), 0, 3e-3f) << f;
    last = change_.translation.y;
  }
  EXPECT_NEAR(last, -0.06f, 1e-3f);
  raised_ = 0;
  run(2, 1);
  EXPECT_EQ(change_.translation.y, 0) << "and goes to the bit";
}

TEST_F(Standing, heels_rise_as_far_as_the_style_stands_on_its_toes) {
  heel_ = 0.6f;
  stance_.heel = 0.35f;
  run(1);
  EXPECT_GT(above_input(HumanJoint::left_foot), 0.02f);
  EXPECT_NEAR(above_input(HumanJoint::left_toes), 0, 2e-3f);
  const Quat foot = change_.rotations[index(HumanJoint::left_foot)];
  EXPECT_NEAR(2 * std::atan2(foot.x, foot.w), 0.35f, 0.05f);
}

TEST_F(Standing, feet_turn_out_no_further_than_the_style_turns_them) {
  turn_ = 0.9f;
  run(1);
  EXPECT_NEAR(turned(), 0.17f, 1e-2f);
  stance_.turn = {0.5f, -0.5f};
  run(1);
  EXPECT_NEAR(turned(), 0.67f, 1e-2f);
  turn_ = -0.9f;
  run(1);
  EXPECT_NEAR(turned(), -0.17f, 1e-2f);
}

TEST_F(Standing, feet_that_step_or_move_are_left_alone_to_the_bit) {
  heel_ = 0.4f;
  run(1, 1);
  EXPECT_TRUE(std::ranges::equal(change_.rotations, asked().rotations));
  first_ = true;
  run(1, 0, 0.8f);
  const int left = index(HumanJoint::left_foot);
  EXPECT_EQ(change_.rotations[left], asked().rotations[left]);
}

TEST_F(Standing, a_foot_that_comes_to_rest_or_leaves_does_so_without_a_jerk) {
  heel_ = 0.4f;
  run(1, 0, 0.8f);
  float last = above_input(HumanJoint::left_toes), speed = 0;
  for (int f = 0; f < 120; ++f) {
    run(1 / 60.0, 0, f < 60 ? 0 : 0.8f);
    const float now = above_input(HumanJoint::left_toes), step = now - last;
    EXPECT_LT(std::abs(step - speed), 0.009f) << f;
    speed = step;
    last = now;
  }
}

TEST_F(Standing, the_pose_after_the_first_tells_whether_the_first_one_rests) {
  NextPose next{body_.joints, 1 / 60.0f};
  const auto first_step = [&] {
    stage_.reset();
    change_ = asked();
    changed_joints(body_, change_, joints_);
    stage_.step(body_, joints_, stance_, 1, 0, 0, 0, 0, {0, 0, true, &next}, change_);
    return stage_.held()[0];
  };
  EXPECT_EQ(first_step(), 1);
  next.world[index(HumanJoint::left_foot)].z += 0.02f;
  EXPECT_EQ(first_step(), 0);
}

TEST(Stance, only_a_style_on_its_toes_lifts_heels) {
  StyleDelta mean;
  const auto lifted = [&](float by) {
    for (const HumanJoint foot : kAnkles) mean.rotations[index(foot)] = {by, 0.2f, 0};
    return stance_of(mean);
  };
  EXPECT_EQ(lifted(0.15f).heel, 0);
  EXPECT_FLOAT_EQ(lifted(0.4f).heel, 0.4f);
  EXPECT_FLOAT_EQ(lifted(0.4f).turn[1], 0.2f);
}

}  // namespace
}  // namespace panache
