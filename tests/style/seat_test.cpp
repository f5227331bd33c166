// A seat is a seat: what holds the body up besides its feet keeps hips and legs where they are.

#include "style/stages/input_watch.h"

#include <gtest/gtest.h>

#include "make_clip.h"
#include "make_model.h"
#include "rig/posed_rig.h"
#include "style/stylizer.h"

namespace panache {
namespace {

using enum HumanJoint;

// `seconds` of a pose with these angles of thighs and knees, hips at this height, that breathes.
Clip held_pose(float thigh, float knee, float height, double seconds = 2) {
  Clip clip = test::walking_clip(static_cast<int>(seconds * 30));
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
Clip sitting() { return held_pose(1.5f, 1.5f, 0.5f); }
Clip standing() { return held_pose(0, 0.05f, 0.92f); }

// At the end of a clip.
float seat_of(const Clip& clip, int from = 0) {
  PosedRig rig(*Rig::create(clip));
  BodyPose body;
  SeatWatch seat;
  for (int f = from; f < clip.frames; ++f) {
    rig.read(clip.pose(f), body);
    seat.step(body.positions, {clip.frame_time, static_cast<float>(clip.frame_time), f == from});
  }
  return seat.amount();
}

TEST(Seat, is_where_the_hips_are_low_and_at_rest) {
  EXPECT_GT(seat_of(sitting()), 0.99f);
  EXPECT_EQ(seat_of(standing()), 0);
  EXPECT_EQ(seat_of(test::walking_clip(90)), 0);
}

TEST(Seat, is_where_the_body_is_beyond_its_feet) {
  // Legs stretched ahead of the hips, as on a bar stool.
  EXPECT_GT(seat_of(held_pose(0.6f, 0, 0.75f)), 0.99f);
}

TEST(Seat, is_there_from_the_first_pose_on) {
  const Clip clip = sitting();
  PosedRig rig(*Rig::create(clip));
  BodyPose body;
  SeatWatch seat;
  for (int f = 0; f < 3; ++f) {
    rig.read(clip.pose(f), body);
    seat.step(body.positions, {clip.frame_time, static_cast<float>(clip.frame_time), f == 0});
    EXPECT_GT(seat.amount(), 0.99f) << f;
  }
}

TEST(Seat, comes_and_goes_slowly) {
  Clip clip = sitting();
  const Clip up = standing();
  for (int f = 0; f < up.frames; ++f) clip.append(up.pose(f));
  PosedRig rig(*Rig::create(clip));
  BodyPose body;
  SeatWatch seat;
  float last = 1;
  for (int f = 0; f < clip.frames; ++f) {
    rig.read(clip.pose(f), body);
    seat.step(body.positions, {clip.frame_time, static_cast<float>(clip.frame_time), f == 0});
    if (f > 0) {
      EXPECT_LT(std::abs(seat.amount() - last), 0.2f) << f;
    }
    last = seat.amount();
  }
  EXPECT_EQ(last, 0);
}

TEST(Seat, keeps_hips_and_legs_bit_for_bit_near_and_lets_the_rest_have_the_style) {
  const Clip clip = sitting();
  const auto model = *Model::parse(format_safetensors(test::make_model({"old"}, 3)), "test model");
  Stylizer stylizer = *Stylizer::create(model, *Rig::create(clip));
  Clip out = clip;
  for (int f = 0; f < clip.frames; ++f) {
    stylizer.step(clip.pose(f), std::vector<float>{1}, clip.frame_time, out.pose(f));
  }
  const int last = clip.frames - 1;
  const auto turned = [&](HumanJoint joint) {
    const auto j = static_cast<size_t>(index(joint));
    return length(
        log_rotation(out.pose(last).rotations[j] * conjugate(clip.pose(last).rotations[j])));
  };
  for (const HumanJoint joint : {hips, left_upper_leg, right_lower_leg, left_foot}) {
    EXPECT_LT(turned(joint), 0.01f) << index(joint);
  }
  EXPECT_LT(length(out.pose(last).translations[0] - clip.pose(last).translations[0]), 0.002f);
  EXPECT_GT(turned(chest) + turned(left_upper_arm) + turned(head), 0.05f);
}

}  // namespace
}  // namespace panache
