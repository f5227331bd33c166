// Limbs stay outside the body.

#include <array>

#include <gtest/gtest.h>

#include "pose/limb.h"
#include "pose/changed_joints.h"
#include "posed_body.h"
#include "style/stages/arms_clear.h"
#include "style/stages/legs_apart.h"

namespace panache {
namespace {

using enum HumanJoint;
using test::kX, test::kY, test::kZ, test::posed_body, test::turned;

constexpr StepTime kPushTime = {1 / 60.0, 1 / 60.0f, false}, kFirst = {1 / 60.0, 1 / 60.0f, true};

struct Pushed {
  BodyChange change;
  HumanPositions joints;
  Vec3 at(HumanJoint joint) const { return joints[index(joint)]; }
};
Pushed wanted_of(const BodyPose& body, const BodyChange& change) {
  Pushed out{change, {}};
  changed_joints(body, change, out.joints);
  return out;
}
Pushed legs(const BodyPose& body, const BodyChange& wanted, std::array<float, 2> planted = {},
            float amount = 1, float stepping = 1) {
  Pushed out = wanted_of(body, wanted);
  LegsApart().step(body, amount, stepping, planted, kFirst, out.joints, out.change);
  return wanted_of(body, out.change);
}
Pushed arms(const BodyPose& body, const BodyChange& wanted, const HandHolds& holds = {},
            float amount = 1) {
  Pushed out = wanted_of(body, wanted);
  ArmsClear().step(body, {amount, amount}, holds, kFirst, out.joints, out.change);
  return wanted_of(body, out.change);
}

// Legs that hang `out` radians apart, knees bent a little.
BodyPose standing(float out = 0) {
  return posed_body({{left_upper_arm, axis_angle(kZ, -1.3f)},
                     {right_upper_arm, axis_angle(kZ, 1.3f)},
                     {left_upper_leg, axis_angle(kZ, out) * axis_angle(kX, -0.3f)},
                     {right_upper_leg, axis_angle(kZ, -out) * axis_angle(kX, -0.3f)},
                     {left_lower_leg, axis_angle(kX, 0.5f)},
                     {right_lower_leg, axis_angle(kX, 0.5f)}});
}
// Thighs and shins turned `in` towards each other.
BodyChange closed(float in) {
  return turned({{left_upper_leg, axis_angle(kZ, -in)}, {right_upper_leg, axis_angle(kZ, in)}});
}

TEST(LegsApart, legs_that_a_style_puts_through_each_other_stay_beside_each_other) {
  for (const float in : {0.12f, 0.2f, 0.35f}) {
    const Pushed missed = wanted_of(standing(), closed(in));
    ASSERT_LT((missed.at(left_foot) - missed.at(right_foot)).x, 0) << "crossed";
    const Pushed out = legs(standing(), closed(in));
    EXPECT_GT((out.at(left_lower_leg) - out.at(right_lower_leg)).x, 0.1f) << in;
    EXPECT_GT((out.at(left_foot) - out.at(right_foot)).x, 0.06f) << in;
  }
}

TEST(LegsApart, legs_that_stand_do_not_cross_in_front_of_each_other) {
  // The right leg goes ahead, and both in: steps may.
  BodyChange wanted = closed(0.15f);
  wanted.rotations[index(right_upper_leg)] = axis_angle(kZ, 0.15f) * axis_angle(kX, -0.5f);
  const auto apart = [](const Pushed& out) { return (out.at(left_foot) - out.at(right_foot)).x; };
  ASSERT_LT(apart(wanted_of(standing(), wanted)), 0);
  EXPECT_LT(apart(legs(standing(), wanted)), 0);
  EXPECT_GT(apart(legs(standing(), wanted, {}, 1, 0)), 0.06f);
}

TEST(LegsApart, bent_knees_swivel_and_planted_feet_stay) {
  const BodyPose body = standing(0.05f);
  // Knees in, feet back out to where they are.
  BodyChange wanted =
      turned({{left_upper_leg, axis_angle(kZ, -0.25f)}, {right_upper_leg, axis_angle(kZ, 0.25f)}});
  wanted.rotations[index(left_lower_leg)] = axis_angle(kZ, 0.3f);
  wanted.rotations[index(right_lower_leg)] = axis_angle(kZ, -0.3f);
  const Pushed missed = wanted_of(body, wanted);
  ASSERT_LT((missed.at(left_lower_leg) - missed.at(right_lower_leg)).x, 0.05f);
  const Pushed out = legs(body, wanted, {1, 1});
  EXPECT_GT((out.at(left_lower_leg) - out.at(right_lower_leg)).x, 0.09f);
  EXPECT_LT(length(out.at(left_foot) - missed.at(left_foot)), 0.005f);
  EXPECT_LT(length(out.at(right_foot) - missed.at(right_foot)), 0.005f);
}

TEST(LegsApart, nothing_changes_where_legs_are_apart_or_as_close_in_the_input) {
  EXPECT_TRUE(test::same(legs(standing(), closed(-0.1f)).change, closed(-0.1f)));
  EXPECT_TRUE(test::same(legs(standing(-0.15f), {}).change, {})) << "close in the input";
  EXPECT_TRUE(test::same(legs(standing(), closed(0.3f), {}, 0).change, closed(0.3f)));
}

// One leg laid over the other.
TEST(LegsApart, legs_that_cross_in_the_input_may_cross) {
  const BodyPose crossed = posed_body(
      {{left_upper_leg, axis_angle(kZ, -0.3f)}, {right_upper_leg, axis_angle(kZ, 0.3f)}});
  EXPECT_TRUE(test::same(legs(crossed, {}).change, {}));
}

TEST(LegsApart, a_push_comes_and_goes_without_a_jump) {
  const BodyPose body = standing();
  LegsApart stage;
  Vec3 last, last_wanted;
  for (int f = 0; f < 240; ++f) {
    const float in = 0.15f - 0.15f * cosine(0.0524f * static_cast<float>(f));
    const Pushed wanted = wanted_of(body, closed(in));
    Pushed out = wanted;
    stage.step(body, 1, 1, {}, f == 0 ? kFirst : kPushTime, out.joints, out.change);
    if (f > 0) {
      const float asked = length(wanted.at(left_foot) - last_wanted);
      EXPECT_LT(length(out.at(left_foot) - last), 2 * asked + 0.004f) << f;
    }
    last = out.at(left_foot), last_wanted = wanted.at(left_foot);
  }
}

TEST(EasedMove, a_push_that_comes_at_once_starts_and_stops_without_a_jerk) {
  EasedMove move;
  move.step({}, kFirst);
  std::array<float, 3> last{};
  float max = 0, highest = 0;
  for (int f = 0; f < 40; ++f) {
    move.step({{0.14f, 0, 0}, {}}, kPushTime);
    const float now = move.now().middle.x;
    max = std::max(max, std::abs(now - 2 * last[0] + last[1]));
    highest = std::max(highest, now);
    last = {now, last[0], last[1]};
  }
  EXPECT_NEAR(last[0], 0.14f, 1e-3f);
  EXPECT_LT(highest, 0.15f);
  EXPECT_LT(max, 20 * kPushTime.output * kPushTime.output * 1.001f);
}

// From the axis of the torso.
float from_torso(const Pushed& body, HumanJoint joint) {
  const Vec3 low = (body.at(left_upper_leg) + body.at(right_upper_leg)) * 0.5f;
  const Vec3 high = (body.at(left_upper_arm) + body.at(right_upper_arm)) * 0.5f;
  return length(from_line(body.at(joint), low, lerp(low, high, 0.85f)));
}

// The forearm bent ahead of the belly, and a style that puts it into it.
BodyPose arm_ahead() {
  return posed_body({{left_upper_arm, axis_angle(kZ, -1.2f)},
                     {left_lower_arm, rotation_y(-1.3f)},
                     {right_upper_arm, axis_angle(kZ, 1.2f)}});
}
BodyChange into_belly() { return turned({{left_lower_arm, rotation_y(-1.3f)}}); }

TEST(ArmsClear, a_hand_that_a_style_puts_into_the_torso_stays_outside) {
  const BodyPose body = arm_ahead();
  const Pushed missed = wanted_of(body, into_belly());
  ASSERT_LT(from_torso(missed, left_hand), 0.12f);
  const Pushed out = arms(body, into_belly());
  EXPECT_GT(from_torso(out, left_hand), 0.14f);
  EXPECT_EQ(out.change.rotations[index(right_upper_arm)], Quat{});
}

TEST(ArmsClear, an_elbow_stays_on_its_own_side_of_the_torso) {
  const BodyPose body = arm_ahead();
  const BodyChange wanted = turned({{left_upper_arm, axis_angle(kZ, -0.8f)}});
  const Pushed missed = wanted_of(body, wanted);
  ASSERT_LT(from_torso(missed, left_lower_arm), 0.1f);
  const Pushed out = arms(body, wanted);
  EXPECT_GT(out.at(left_lower_arm).x, 0.1f);
}

TEST(ArmsClear, hands_that_hold_each_other_move_together) {
  const BodyPose body = posed_body({{left_upper_arm, axis_angle(kZ, -1.2f)},
                                    {left_lower_arm, rotation_y(-1.3f)},
                                    {right_upper_arm, axis_angle(kZ, 1.2f)},
                                    {right_lower_arm, rotation_y(1.3f)}});
  const BodyChange wanted =
      turned({{left_lower_arm, rotation_y(-1.3f)}, {right_lower_arm, rotation_y(1.3f)}});
  const Pushed missed = wanted_of(body, wanted);
  HandHolds holds;
  holds.together = 1;
  const Pushed out = arms(body, wanted, holds);
  ASSERT_FALSE(test::same(out.change, wanted));
  const auto between = [](const Pushed& s) { return s.at(right_hand) - s.at(left_hand); };
  EXPECT_LT(length(between(out) - between(missed)), 0.005f);
}

TEST(ArmsClear, nothing_changes_where_arms_are_clear_or_as_deep_in_the_input) {
  const BodyPose body = arm_ahead();
  const BodyChange away = turned({{left_lower_arm, rotation_y(0.3f)}});
  EXPECT_TRUE(test::same(arms(body, away).change, away));
  EXPECT_TRUE(test::same(arms(body, into_belly(), {}, 0).change, into_belly()));
  const BodyPose inside =
      posed_body({{left_upper_arm, axis_angle(kZ, -1.2f)}, {left_lower_arm, rotation_y(-2.5f)}});
  EXPECT_TRUE(test::same(arms(inside, {}).change, {}));
}

}  // namespace
}  // namespace panache
