#include "style/stages/hand_contacts.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "pose/changed_joints.h"
#include "posed_body.h"

namespace panache {
namespace {

using enum HumanJoint;
using test::kX, test::kY, test::kZ, test::posed_body, test::turned;

constexpr float kSeconds = 1 / 60.0f;

// Both arms ahead, so far in (radians) that the wrists meet at 1.9.
BodyPose hands_ahead(float in) {
  return posed_body({{left_upper_arm, rotation_y(-in)}, {right_upper_arm, rotation_y(in)}});
}
// The left hand at the head.
BodyPose hand_at_head() {
  return posed_body({{left_upper_arm, axis_angle(kZ, 0.3f)},
                     {left_lower_arm, axis_angle(kZ, 2.3f)},
                     {right_upper_arm, axis_angle(kZ, 1.4f)}});
}
// Seated, the left hand on its thigh, the right arm out.
BodyPose hand_on_thigh() {
  return posed_body({{left_upper_arm, axis_angle(kX, -0.45f) * axis_angle(kZ, -1.45f)},
                     {left_upper_leg, axis_angle(kX, -1.5f)},
                     {right_upper_leg, axis_angle(kX, -1.5f)},
                     {left_lower_leg, axis_angle(kX, 1.5f)},
                     {right_lower_leg, axis_angle(kX, 1.5f)}},
                    0.5f);
}
// Arms spread, torso turned and bent.
BodyChange spread() {
  return turned({{chest, rotation_y(0.3f) * axis_angle(kX, 0.3f)},
                 {left_upper_arm, axis_angle(kZ, -0.4f) * rotation_y(0.5f)},
                 {right_upper_arm, rotation_y(-0.5f)}});
}

struct Stepped {
  BodyChange change;
  HumanPositions joints;
  HandHolds holds;
};
Stepped step(HandContacts& hands, const BodyPose& body, const BodyChange& wanted, bool first,
             float amount = 1, float firmness = 1) {
  Stepped out;
  out.change = wanted;
  changed_joints(body, out.change, out.joints);
  hands.step(body, firmness, {amount, amount}, {kSeconds, kSeconds, first}, out.joints, out.change);
  changed_joints(body, out.change, out.joints);
  out.holds = hands.holds();
  return out;
}
Stepped held(const BodyPose& body, const BodyChange& wanted, float amount = 1, float firmness = 1) {
  HandContacts hands;
  Stepped out;
  for (int f = 0; f < 60; ++f) out = step(hands, body, wanted, f == 0, amount, firmness);
  return out;
}

float apart(const HumanPositions& joints, HumanJoint a, HumanJoint b) {
  return length(joints[index(a)] - joints[index(b)]);
}

TEST(HandContacts, hands_that_meet_stay_as_near) {
  const BodyPose body = hands_ahead(1.85f);
  const float before = apart(body.joints, left_hand, right_hand);
  ASSERT_LT(before, 0.15f);
  HumanPositions missed;
  changed_joints(body, spread(), missed);
  ASSERT_GT(apart(missed, left_hand, right_hand), before + 0.2f);
  const Stepped out = held(body, spread());
  // Nearly straight arms reach within half a centimetre.
  EXPECT_NEAR(apart(out.joints, left_hand, right_hand), before, 5e-3f);
  EXPECT_EQ(out.holds.together, 1);
}

TEST(HandContacts, a_hand_at_the_head_stays_at_the_place_of_the_head) {
  const BodyPose body = hand_at_head();
  const float before = apart(body.joints, left_hand, head);
  ASSERT_LT(before, 0.27f);
  const BodyChange wanted =
      turned({{neck, axis_angle(kX, 0.5f)}, {left_upper_arm, axis_angle(kZ, -0.9f)}});
  const Stepped out = held(body, wanted);
  const Vec3 position =
      rotate(rotation_y(-body.facing), body.joints[index(left_hand)] - body.joints[index(head)]);
  const Vec3 now = out.joints[index(left_hand)] - out.joints[index(head)];
  EXPECT_LT(length(now - rotate(wanted.rotations[index(head)], position)), 1e-3f);
  EXPECT_EQ(out.change.rotations[index(right_upper_arm)], wanted.rotations[index(right_upper_arm)]);
  EXPECT_EQ(out.change.rotations[index(chest)], wanted.rotations[index(chest)]);
}

TEST(HandContacts, an_arm_that_is_folded_does_not_throw_its_elbow_about) {
  // A guard: the wrist at the shoulder and near the head, which the style leans over it and back.
  const BodyPose body = posed_body({{left_upper_arm, axis_angle(kZ, -0.6f)},
                                    {left_lower_arm, axis_angle(kZ, 2.72f)},
                                    {right_upper_arm, axis_angle(kZ, 1.4f)}});
  ASSERT_LT(apart(body.joints, left_hand, left_upper_arm), 0.15f);
  HandContacts hands;
  Vec3 last;
  float fastest = 0;
  for (int f = 0; f < 240; ++f) {
    const float lean = 1.1f * std::sin(static_cast<float>(f) * 0.05f);
    const BodyChange wanted = turned({{neck, axis_angle(kZ, -lean) * axis_angle(kX, 0.3f)},
                                      {left_upper_arm, rotation_y(0.5f * lean)}});
    const Vec3 elbow = step(hands, body, wanted, f == 0).joints[index(left_lower_arm)];
    if (f > 0) fastest = std::max(fastest, length(elbow - last));
    last = elbow;
  }
  EXPECT_LT(fastest, 0.06f);  // Metres in a frame.
}

TEST(HandContacts, a_hand_that_rests_on_a_thigh_goes_with_it) {
  const BodyPose body = hand_on_thigh();
  const BodyChange wanted = turned({{chest, axis_angle(kX, 0.05f)},
                                    {left_upper_arm, axis_angle(kZ, 0.05f)},
                                    {left_upper_leg, rotation_y(0.1f)}});
  const Stepped out = held(body, wanted);
  EXPECT_EQ(out.holds.by_body[0], 1);
  EXPECT_EQ(out.holds.by_body[1], 0);
  EXPECT_NEAR(apart(out.joints, left_hand, left_lower_leg),
              apart(body.joints, left_hand, left_lower_leg), 1e-3f);
}

TEST(HandContacts, a_style_that_moves_the_arm_takes_a_resting_hand_along_bit_for_bit) {
  const BodyChange wanted = turned({{left_upper_arm, axis_angle(kZ, 0.9f)}});
  const Stepped out = held(hand_on_thigh(), wanted);
  EXPECT_EQ(out.holds.by_body[0], 0);
  EXPECT_TRUE(test::same(out.change, wanted));
  // Half of it still lets go in part; a hand at the head holds.
  const Stepped half = held(hand_on_thigh(), turned({{left_upper_arm, axis_angle(kZ, 0.35f)}}));
  EXPECT_GT(half.holds.by_body[0], 0.1f);
  EXPECT_LT(half.holds.by_body[0], 0.9f);
  EXPECT_EQ(held(hand_at_head(), wanted).holds.by_body[0], 1);
}

TEST(HandContacts, are_as_firm_as_the_user_wants_them) {
  const BodyPose body = hands_ahead(1.85f);
  const auto missed = [&](float firmness) {
    return std::abs(apart(held(body, spread(), 1, firmness).joints, left_hand, right_hand) -
                    apart(body.joints, left_hand, right_hand));
  };
  EXPECT_LT(missed(1), 5e-3f);
  EXPECT_GT(missed(0.5f), missed(1) + 0.05f);
  EXPECT_GT(missed(0), missed(0.5f) + 0.05f);
  EXPECT_TRUE(test::same(held(body, spread(), 1, 0).change, spread()));
}

TEST(HandContacts, a_hand_that_passes_a_thigh_is_free) {
  HandContacts hands;
  for (int f = 0; f < 60; ++f) {
    const float swing = 0.3f * sine(0.3f * static_cast<float>(f));  // 2.9 Hz
    BodyPose body = hand_on_thigh();
    body.joints[index(left_hand)].z += swing;
    const Stepped out = step(hands, body, spread(), f == 0);
    // A first pose counts as one at rest.
    if (f > 50) {
      EXPECT_LT(out.holds.by_body[0], 0.2f) << f;
    }
  }
}

TEST(HandContacts, arms_that_swing_beside_a_walking_body_keep_their_style_bit_for_bit) {
  const Clip clip = test::walking_clip(60);
  PosedRig rig(*Rig::create(clip));
  HandContacts hands;
  for (int f = 0; f < clip.frames; ++f) {
    BodyPose body;
    rig.read(clip.pose(f), body);
    const Stepped out = step(hands, body, spread(), f == 0);
    ASSERT_TRUE(test::same(out.change, spread())) << f;
  }
}

TEST(HandContacts, without_a_style_nothing_changes_bit_for_bit) {
  EXPECT_TRUE(test::same(held(hands_ahead(1.85f), {}).change, {}));
  EXPECT_TRUE(test::same(held(hand_on_thigh(), spread(), 0).change, spread()));
}

// Hands come together and part again: neither wrist moves much faster than in the input.
TEST(HandContacts, a_contact_comes_and_goes_without_a_jump) {
  HandContacts hands;
  Vec3 last_in, last_out;
  float fastest_in = 0, fastest_out = 0;
  for (int f = 0; f < 180; ++f) {
    const float in = 1.4f - 0.45f * cosine(0.105f * static_cast<float>(f));  // Once a second.
    const BodyPose body = hands_ahead(in);
    const Vec3 now = body.joints[index(left_hand)];
    const Vec3 out = step(hands, body, spread(), f == 0).joints[index(left_hand)];
    if (f > 0) {
      fastest_in = std::max(fastest_in, length(now - last_in));
      fastest_out = std::max(fastest_out, length(out - last_out));
    }
    last_in = now, last_out = out;
  }
  EXPECT_LT(fastest_out, 2.5f * fastest_in);
}

}  // namespace
}  // namespace panache
