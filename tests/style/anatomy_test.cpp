#include "style/stages/anatomy.h"

#include <gtest/gtest.h>

#include "make_clip.h"
#include "pose/changed_joints.h"
#include "rig/posed_rig.h"

namespace panache {
namespace {

using enum HumanJoint;

constexpr float kDegree = 3.14159265f / 180;
constexpr Vec3 kLeft = {1, 0, 0};

float degrees_between(Vec3 a, Vec3 b) {
  return arc_tangent(length(cross(a, b)), dot(a, b)) / kDegree;
}

// The walk at a moment, and changes of it.
class AnatomyTest : public testing::Test {
 protected:
  AnatomyTest() : clip_(test::walking_clip(31)), rig_(*Rig::create(clip_)) { read(clip_.pose(0)); }

  void read(ConstPose pose) { rig_.read(pose, body_); }
  static BodyChange turned(HumanJoint first, HumanJoint last, Quat by) {
    BodyChange change{};
    for (int j = index(first); j <= index(last); ++j) change.rotations[j] = by;
    return change;
  }
  // What a character has that asks for this change from its first step on.
  BodyChange kept(BodyChange change) const {
    Anatomy anatomy;
    anatomy.step(body_, rig_.rig(), {}, change);
    return change;
  }
  Vec3 direction(const BodyChange& change, HumanJoint from, HumanJoint to) const {
    HumanPositions joints;
    changed_joints(body_, change, joints);
    return normalized(joints[index(to)] - joints[index(from)]);
  }
  float wrist(const BodyChange& change) const {
    const Vec3 fingers = rotate(body_.hands[0], rig_.rig().hand_direction(0));
    const Vec3 now =
        rotate(change.rotations[index(left_hand)], rotate(rotation_y(-body_.facing), fingers));
    return degrees_between(direction(change, left_lower_arm, left_hand), now);
  }

  Clip clip_;
  PosedRig rig_;
  BodyPose body_;
};

TEST_F(AnatomyTest, no_change_stays_none_to_the_bit) {
  for (int f = 0; f < clip_.frames; ++f) {
    read(clip_.pose(f));
    const BodyChange none = kept({});
    for (const Quat q : none.rotations) EXPECT_EQ(q, Quat{});
  }
  // Nor does it touch the input's own: a hand bent as no hand can be.
  clip_.pose(0).rotations[static_cast<size_t>(index(left_hand))] = axis_angle(Vec3{0, 0, 1}, -2.0f);
  read(clip_.pose(0));
  for (const Quat q : kept({}).rotations) EXPECT_EQ(q, Quat{});
}

TEST_F(AnatomyTest, a_wrist_bends_as_far_as_a_wrist_can_and_gets_there_softly) {
  ASSERT_LT(wrist({}), 5);
  float last = wrist({});
  for (int degrees = 0; degrees <= 170; ++degrees) {
    const BodyChange asked =
        turned(left_hand, left_hand, axis_angle(kLeft, static_cast<float>(degrees) * kDegree));
    const BodyChange given = kept(asked);
    if (degrees < 65) {
      EXPECT_EQ(given.rotations, asked.rotations) << degrees;
    }
    EXPECT_LT(wrist(given), 80) << degrees;
    EXPECT_LT(std::abs(wrist(given) - last), 1.1f) << degrees;
    last = wrist(given);
  }
  EXPECT_GT(last, 70);
}

TEST_F(AnatomyTest, a_wrist_that_the_input_bends_too_far_bends_no_further) {
  clip_.pose(0).rotations[static_cast<size_t>(index(left_hand))] =
      axis_angle(Vec3{0, 0, 1}, -100 * kDegree);
  read(clip_.pose(0));
  const float before = wrist({});
  ASSERT_NEAR(before, 100, 8);
  // Some way further, about the axis of the bend.
  const Vec3 fingers = rotate(body_.hands[0], rig_.rig().hand_direction(0));
  const Vec3 about = normalized(cross(direction({}, left_lower_arm, left_hand), fingers));
  const BodyChange asked = turned(left_hand, left_hand, axis_angle(about, 40 * kDegree));
  ASSERT_GT(wrist(asked), before + 35);
  const BodyChange given = kept(asked);
  EXPECT_GT(wrist(given), before - 0.1f);
  EXPECT_LT(wrist(given), before + 2);
}

TEST_F(AnatomyTest, knees_do_not_bend_forward_nor_elbows_back) {
  const BodyChange knee = kept(turned(left_lower_leg, left_toes, axis_angle(kLeft, -0.6f)));
  const BodyChange elbow = kept(turned(left_lower_arm, left_hand, axis_angle(kLeft, 0.9f)));
  const auto bend = [&](const BodyChange& change, HumanJoint upper, HumanJoint lower,
                        HumanJoint end) {
    const Vec3 above = direction(change, upper, lower), below = direction(change, lower, end);
    return dot(cross(above, below), kLeft) > 0 ? degrees_between(above, below)
                                               : -degrees_between(above, below);
  };
  EXPECT_GT(bend(knee, left_upper_leg, left_lower_leg, left_foot), -3);
  EXPECT_LT(bend(elbow, left_upper_arm, left_lower_arm, left_hand), 15);
}

TEST_F(AnatomyTest, a_twist_of_the_upper_arm_does_not_bend_its_elbow_the_wrong_way) {
  // In the input the forearm points ahead.
  for (HumanPositions* joints : {&body_.positions, &body_.joints}) {
    const Vec3 elbow = (*joints)[index(left_lower_arm)];
    Vec3& hand = (*joints)[index(left_hand)];
    hand = elbow +
           rotate(axis_angle(rotate(rotation_y(body_.facing), kLeft), -60 * kDegree), hand - elbow);
  }
  const Vec3 arm = direction({}, left_upper_arm, left_lower_arm);
  const auto ahead = [&](const BodyChange& change) {
    return dot(direction(change, left_lower_arm, left_hand), Vec3{0, 0, 1});
  };
  ASSERT_GT(ahead({}), 0.7f);
  const BodyChange twist = turned(left_upper_arm, left_hand, axis_angle(arm, 160 * kDegree));
  ASSERT_LT(ahead(twist), -0.3f);
  EXPECT_GT(ahead(kept(twist)), 0.1f);
}

TEST_F(AnatomyTest, a_torso_is_not_turned_around_and_its_arms_go_with_it) {
  float last = 0;
  for (int degrees = 0; degrees <= 170; degrees += 10) {
    const Quat asked = rotation_y(static_cast<float>(degrees) * kDegree);
    const BodyChange given = kept(turned(spine, right_hand, asked));
    const float turn = length(log_rotation(given.rotations[index(spine)])) / kDegree;
    if (degrees <= 60) {
      EXPECT_EQ(given.rotations[index(spine)], asked) << degrees;
    } else {
      EXPECT_LT(turn, std::min(90, degrees - 1)) << degrees;
      EXPECT_GT(turn, last) << degrees;
    }
    last = turn;
    for (const HumanJoint joint : {chest, head, left_shoulder, right_hand}) {
      const Quat own = conjugate(given.rotations[index(spine)]) * given.rotations[index(joint)];
      EXPECT_LT(length(log_rotation(own)), 1e-3f) << degrees;
    }
    EXPECT_EQ(given.rotations[index(left_upper_leg)], Quat{});
  }
  EXPECT_GT(last, 75);
  // Arms may turn further: raised, or folded.
  const Quat raised = rotation_y(100 * kDegree);
  EXPECT_EQ(kept(turned(left_shoulder, left_hand, raised)).rotations[index(left_shoulder)], raised);
}

// A foot that is held pulls its thigh across the other after the limits were kept.
TEST_F(AnatomyTest, a_held_leg_goes_back_as_far_as_its_thigh_needs) {
  const auto inward = [&](float degrees, bool right) {
    const Quat turn = axis_angle(Vec3{0, 0, 1}, (right ? degrees : -degrees) * kDegree);
    return right ? turned(right_upper_leg, right_lower_leg, turn)
                 : turned(left_upper_leg, left_lower_leg, turn);
  };
  const BodyChange free = {};
  for (const bool right : {false, true}) {
    const auto kept = [&](float degrees) {
      BodyChange change = inward(degrees, right);
      std::array<float, 2> released{};
      keep_held_legs(body_, free, {}, released, change);
      EXPECT_EQ(released[right ? 0 : 1], 0) << "the other leg";
      EXPECT_EQ(released[right ? 1 : 0] > 0, degrees > 45) << degrees;
      const int thigh = index(right ? right_upper_leg : left_upper_leg);
      return length(log_rotation(change.rotations[thigh])) / kDegree;
    };
    EXPECT_NEAR(kept(0), 0, 1e-3f);
    EXPECT_NEAR(kept(20), 20, 1e-3f);
    EXPECT_NEAR(kept(60), 40, 5) << "30 degrees and their margin";
    EXPECT_NEAR(kept(80), kept(60), 3);
  }
}

TEST_F(AnatomyTest, a_leg_at_its_limit_is_released_within_a_few_frames_and_held_again_slowly) {
  const BodyChange free = {};
  BodyChange change =
      turned(left_upper_leg, left_lower_leg, axis_angle(Vec3{0, 0, 1}, -70 * kDegree));
  std::array<float, 2> released{};
  keep_held_legs(body_, free, {}, released, change);
  const float first = released[0];
  ASSERT_GT(first, 0.2f);
  change = turned(left_upper_leg, left_lower_leg, axis_angle(Vec3{0, 0, 1}, -20 * kDegree));
  keep_held_legs(body_, free, {0.03, 0.03, false}, released, change);
  EXPECT_GT(released[0], 0.85f * first);
  EXPECT_LT(released[0], first);

  released = {};
  for (const float until : {0.25f, 0.5f}) {
    change = turned(left_upper_leg, left_lower_leg, axis_angle(Vec3{0, 0, 1}, -170 * kDegree));
    keep_held_legs(body_, free, {0.03, 0.03, false}, released, change);
    EXPECT_NEAR(released[0], until, 0.04f);
  }
}

TEST_F(AnatomyTest, a_limit_comes_and_goes_gradually) {
  Anatomy anatomy;
  const StepTime later{0.02, 0.02, false};
  const BodyChange asked = turned(left_hand, left_hand, axis_angle(kLeft, 150 * kDegree));
  BodyChange given = {};
  anatomy.step(body_, rig_.rig(), {}, given);
  float last = wrist(asked);
  for (int i = 0; i < 80; ++i) {
    given = asked;
    anatomy.step(body_, rig_.rig(), later, given);
    EXPECT_LT(last - wrist(given), 10) << i;
    last = wrist(given);
  }
  EXPECT_LT(last, 81);

  const BodyChange easy = turned(left_hand, left_hand, axis_angle(kLeft, 60 * kDegree));
  const auto taken_back = [&] {
    given = easy;
    anatomy.step(body_, rig_.rig(), later, given);
    return wrist(easy) - wrist(given);
  };
  const float at_first = taken_back();
  ASSERT_GT(at_first, 15);
  for (int i = 0; i < 10; ++i) last = taken_back();
  EXPECT_GT(last, 0.4f * at_first) << "after 0.2 s";
  for (int i = 0; i < 100; ++i) last = taken_back();
  EXPECT_LT(last, 0.1f);
}

}  // namespace
}  // namespace panache
