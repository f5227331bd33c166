// What the input tells of itself: a seat keeps hips and legs where they are, and who stands keeps
// the input's time.

#include "style/stages/input_watch.h"

#include <cmath>

#include <gtest/gtest.h>

#include "make_clip.h"
#include "make_model.h"
#include "rig/posed_rig.h"
#include "style/stylizer.h"
#include "style_checks.h"

namespace panache {
namespace {

using enum HumanJoint;

// Two seconds of a pose with these angles of thighs and knees, hips at this height, that breathes.
Clip held_pose(float thigh, float knee, float height) {
  Clip clip = test::walking_clip(60);
  for (int f = 0; f < clip.frames; ++f) {
    const Pose pose = clip.pose(f);
    const auto turn = [&](HumanJoint joint, float angle) {
      pose.rotations[static_cast<size_t>(index(joint))] = axis_angle(Vec3{1, 0, 0}, angle);
    };
    for (const HumanJoint leg : {left_upper_leg, right_upper_leg}) turn(leg, -thigh);
    for (const HumanJoint shank : {left_lower_leg, right_lower_leg}) turn(shank, knee);
    turn(chest, 0.02f * static_cast<float>(f % 30) / 30);
    pose.translations[0] = {0, height, 0};
  }
  return clip;
}
Clip sitting_still() { return held_pose(1.5f, 1.5f, 0.5f); }
Clip standing_still() { return held_pose(0, 0.05f, 0.92f); }

// After each frame.
std::vector<float> seats_of(const Clip& clip) {
  PosedRig rig(*Rig::create(clip));
  BodyPose body;
  SeatWatch seat;
  std::vector<float> out;
  for (int f = 0; f < clip.frames; ++f) {
    rig.read(clip.pose(f), body);
    seat.step(body.positions, {clip.frame_time, static_cast<float>(clip.frame_time), f == 0});
    out.push_back(seat.amount());
  }
  return out;
}

TEST(Seat, is_where_the_hips_are_low_and_at_rest_from_the_first_pose_on) {
  for (const float amount : seats_of(sitting_still())) EXPECT_GT(amount, 0.99f);
  EXPECT_EQ(seats_of(standing_still()).back(), 0);
  EXPECT_EQ(seats_of(test::walking_clip(90)).back(), 0);
}

TEST(Seat, is_where_the_body_is_beyond_its_feet) {
  // Legs stretched ahead of the hips, as on a bar stool.
  EXPECT_GT(seats_of(held_pose(0.6f, 0, 0.75f)).back(), 0.99f);
}

TEST(Seat, comes_and_goes_slowly) {
  Clip clip = sitting_still();
  const Clip up = standing_still();
  for (int f = 0; f < up.frames; ++f) clip.append(up.pose(f));
  const std::vector<float> seats = seats_of(clip);
  for (size_t f = 1; f < seats.size(); ++f) EXPECT_LT(std::abs(seats[f] - seats[f - 1]), 0.2f) << f;
  EXPECT_EQ(seats.back(), 0);
}

TEST(Seat, keeps_hips_and_legs_bit_for_bit_near_and_lets_the_rest_have_the_style) {
  const Clip clip = sitting_still();
  Stylizer stylizer = *Stylizer::create(read(test::make_model({"old"}, 3)), *Rig::create(clip));
  const Clip out = played(stylizer, clip, {1});
  const ConstPose before = clip.pose(clip.frames - 1), after = out.pose(clip.frames - 1);
  const auto turned = [&](HumanJoint joint) {
    const auto j = static_cast<size_t>(index(joint));
    return length(log_rotation(after.rotations[j] * conjugate(before.rotations[j])));
  };
  for (const HumanJoint joint : {hips, left_upper_leg, right_lower_leg, left_foot}) {
    EXPECT_LT(turned(joint), 0.01f) << index(joint);
  }
  EXPECT_LT(length(after.translations[0] - before.translations[0]), 0.002f);
  EXPECT_GT(turned(chest) + turned(left_upper_arm) + turned(head), 0.05f);
}

// Feet that step by turns at this speed over the ground, m/s, for `seconds`, at this rate.
void step_along(StepWatch& watch, float speed, double seconds, double rate = 60) {
  static double clock = 0;
  const double cycle = 1;
  for (int f = 0; f < seconds * rate; ++f) {
    clock += 1 / rate;
    HumanPositions world{};
    for (int side = 0; side < 2; ++side) {
      // Half of the cycle a foot stands, in the other half it goes twice as fast as the body.
      const double phase = clock / cycle + 0.5 * side, whole = std::floor(phase);
      const double share = std::max(0.0, 2 * (phase - whole) - 1);
      const HumanJoint foot = side == 0 ? HumanJoint::left_foot : HumanJoint::right_foot;
      world[index(foot)] = {0, 0.1f, speed * static_cast<float>(cycle * (whole + share))};
    }
    watch.step(world, {1 / rate, static_cast<float>(1 / rate), f == 0 && clock < 1.5 / rate});
  }
}

TEST(StepWatch, tells_a_walk_from_standing_and_eases_between_them) {
  StepWatch watch;
  watch.step({}, {0, 0, true});
  EXPECT_EQ(watch.amount(), 0);
  step_along(watch, 0.8f, 2);
  EXPECT_EQ(watch.amount(), 1);
  step_along(watch, 0, 0.1);
  EXPECT_GT(watch.amount(), 0.9f);
  float before = watch.amount();
  for (int i = 0; i < 40; ++i) {
    step_along(watch, 0, 1 / 60.0);
    EXPECT_LE(watch.amount(), before);
    EXPECT_GT(watch.amount(), before - 0.1f);
    before = watch.amount();
  }
  step_along(watch, 0, 1);
  EXPECT_EQ(watch.amount(), 0);
}

TEST(StepWatch, shifting_the_weight_is_no_step_at_any_rate) {
  for (const double rate : {30.0, 120.0}) {
    StepWatch watch;
    watch.step({}, {0, 0, true});
    step_along(watch, 0, 0.1, rate);
    step_along(watch, 0.1f, 2, rate);
    EXPECT_EQ(watch.amount(), 0) << rate;
  }
}

}  // namespace
}  // namespace panache
