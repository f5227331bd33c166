#include "pose/foot_lock.h"
#include "pose/limb.h"
#include "pose/changed_joints.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "base/random.h"
#include "make_clip.h"
#include "rig/posed_rig.h"

namespace panache {
namespace {

constexpr std::array<float, kFeet> kUnlevelled{};  // No height is given already.

constexpr Vec3 kHip{0, 0.9f, 0}, kKnee{0, 0.48f, 0.05f}, kAnkle{0, 0.08f, 0};

Vec3 reached(const TwoBoneTurn& turn, Vec3 hip, Vec3 knee, Vec3 ankle) {
  return hip + rotate(turn.upper, knee - hip) + rotate(turn.lower, ankle - knee);
}

// Of the leg, with its knee ahead.
TwoBoneTurn turn_to(Vec3 target) {
  return two_bone_ik(kHip, kKnee, kAnkle, target, bend_of(kHip, kKnee, kAnkle, {0, 0, 1}));
}

TEST(TwoBoneIk, a_target_in_reach_is_met_and_the_knee_keeps_its_side) {
  Random random(7);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 target = kAnkle + Vec3{0.2f * random.normal(), 0.05f + 0.1f * random.uniform(),
                                      0.2f * random.normal()};
    if (length(target - kHip) > 0.8f) continue;
    const TwoBoneTurn turn = turn_to(target);
    EXPECT_LT(length(reached(turn, kHip, kKnee, kAnkle) - target), 1e-4f);
    const Vec3 knee = kHip + rotate(turn.upper, kKnee - kHip);
    EXPECT_GT(knee.z, (kHip.z + target.z) / 2 - 0.02f) << "the knee bends backwards";
  }
}

TEST(TwoBoneIk, a_target_at_the_end_itself_turns_nothing) {
  const TwoBoneTurn turn = turn_to(kAnkle);
  EXPECT_LT(length(turn.upper.xyz()), 1e-3f);
  EXPECT_LT(length(turn.lower.xyz()), 1e-3f);
}

TEST(TwoBoneIk, a_target_out_of_reach_is_approached_and_stays_finite) {
  for (const Vec3 target : {Vec3{0, -5, 0}, Vec3{9, 0, 9}, kHip, Vec3{1e20f, 0, 0}}) {
    const TwoBoneTurn turn = turn_to(target);
    EXPECT_TRUE(is_finite(turn.upper) && is_finite(turn.lower));
    const float reach = length(reached(turn, kHip, kKnee, kAnkle) - kHip);
    EXPECT_LE(reach, 0.83f);
  }
}

// A leg whose knee goes through straight and a little backwards, its foot held 5 cm higher.
TEST(TwoBoneIk, a_knee_that_is_nearly_straight_bends_to_its_hint_and_never_flips) {
  constexpr float kFirm = 0.05f;
  Vec3 last;
  for (float bend = 0.2f; bend > -0.12f; bend -= 0.01f) {
    const Vec3 knee = kHip + Vec3{0, -0.4f * cosine(bend / 2), 0.4f * sine(bend / 2)};
    const Vec3 ankle = kHip + Vec3{0, -0.8f * cosine(bend / 2), 0};
    const TwoBoneTurn turn = two_bone_ik(kHip, knee, ankle, ankle + Vec3{0, 0.05f, 0},
                                         bend_of(kHip, knee, ankle, {0.1f, 0, 1}, kFirm));
    const Vec3 now = kHip + rotate(turn.upper, knee - kHip);
    EXPECT_GT(now.z, kHip.z + 0.1f) << bend;
    if (last != Vec3{}) {
      EXPECT_LT(length(now - last), 0.01f) << bend;
    }
    last = now;
  }
}

// Where the left knee goes, from its hip, at 120 Hz, while its toe is drawn up from 3 cm below the
// floor.
// `aheads`: how far the input's knee is ahead of the line from hip to ankle, a number a frame.
std::vector<Vec3> knees_of(const std::vector<float>& aheads) {
  const Clip clip = test::walking_clip(1);
  PosedRig rig(*Rig::create(clip));
  BodyPose body;
  rig.read(clip.pose(0), body);
  HumanPositions joints;
  changed_joints(body, {}, joints);
  const size_t hip = index(HumanJoint::left_upper_leg), knee = index(HumanJoint::left_lower_leg);
  const size_t ankle = index(HumanJoint::left_foot), toe = index(HumanJoint::left_toes);
  const float thigh = length(joints[knee] - joints[hip]);
  const Vec3 foot = joints[toe] - joints[ankle];
  FootLock lock;
  const float contacts[kFeet] = {0, 0};
  std::vector<Vec3> knees;
  for (const float ahead : aheads) {
    const float down = std::sqrt(thigh * thigh - ahead * ahead);
    joints[knee] = joints[hip] + Vec3{0.004f, -down, ahead};
    joints[ankle] = joints[hip] + Vec3{0, -2 * down, 0};
    joints[toe] = joints[ankle] + foot;
    BodyChange change;
    change.translation.y = -0.03f - (mid_hip(body).y + joints[toe].y);
    lock.step(body, joints, contacts, kUnlevelled, 1, 0, {1 / 120.0f, 1 / 120.0f}, change);
    knees.push_back(rotate(change.rotations[hip], joints[knee] - joints[hip]));
  }
  return knees;
}

// A style takes the knee from a little backwards to a little ahead.
TEST(FootLock, a_knee_that_changes_its_side_goes_around_the_leg) {
  std::vector<float> aheads;
  for (int f = 0; f < 60; ++f) {
    aheads.push_back(0.01f * std::clamp(static_cast<float>(f) - 20, -5.0f, 5.0f));
  }
  const std::vector<Vec3> knees = knees_of(aheads);
  EXPECT_LT(knees.front().z, -0.05f);
  EXPECT_GT(knees.back().z, 0.05f);
  for (size_t f = 1; f < knees.size(); ++f) {
    EXPECT_LT(length(knees[f] - knees[f - 1]), 0.03f) << f;
  }
}

TEST(FootLock, a_knee_that_is_well_bent_stays_on_the_side_that_it_is_on) {
  const std::vector<Vec3> knees = knees_of({0.15f, 0.15f, -0.15f, -0.15f, 0.15f});
  for (const size_t f : {0, 1, 4}) EXPECT_GT(knees[f].z, 0.1f) << f;
  for (const size_t f : {2, 3}) EXPECT_LT(knees[f].z, -0.1f) << f;
}

// A standing body whose style pushes the hips sideways: the planted foot must stay.
class Sliding {
 public:
  Sliding() : clip_(test::walking_clip(1)), rig_(*Rig::create(clip_)) {
    rig_.read(clip_.pose(0), body_);
  }
  // World position of the left toe once the change of frame f is locked.
  Vec3 step(int f, float contact, float amount, float deeper = 0) {
    return lock(body_, {0.002f * static_cast<float>(f), -deeper, 0}, contact, amount);
  }
  // The same where the input slides and the style changes nothing.
  Vec3 step_of_sliding_input(int f, float contact) {
    BodyPose body = body_;
    for (Vec3& joint : body.joints) joint.x += 0.002f * static_cast<float>(f);
    return lock(body, {}, contact, 1);
  }
  // The same where it slides at this speed, in m/s of its own time.
  Vec3 step_of_input_at(float speed, int f, float contact) {
    return step_of_sliding_input(static_cast<int>(speed * rate_ / 30 * f / 0.002f), contact);
  }
  // Input seconds per output second.
  void play_at(float rate) { rate_ = rate; }
  // How much higher the ground is under the style's feet, metres.
  void climb(float ground) { ground_ = ground; }

 private:
  Vec3 lock(const BodyPose& body, Vec3 moved, float contact, float amount) {
    BodyChange change;
    change.translation = moved;
    const float contacts[kFeet] = {contact, 0};
    HumanPositions joints;
    changed_joints(body, change, joints);
    lock_.step(body, joints, contacts, kUnlevelled, amount, ground_, {rate_ / 30, 1 / 30.0f},
               change);
    changed_joints(body, change, joints);
    const Vec3 toe = joints[index(HumanJoint::left_toes)];
    return mid_hip(body) + change.translation + rotate(rotation_y(body.facing), toe);
  }

  Clip clip_;
  PosedRig rig_;
  BodyPose body_;
  FootLock lock_;
  float rate_ = 1, ground_ = 0;
};

TEST(FootLock, a_planted_foot_stays_and_a_free_one_slides) {
  Sliding locked, loose;
  const Vec3 start = locked.step(0, 1, 1);
  loose.step(0, 0, 1);
  Vec3 held, slid;
  for (int f = 1; f <= 20; ++f) {
    held = locked.step(f, 1, 1);
    slid = loose.step(f, 0, 1);
  }
  EXPECT_LT(length(held - start), 0.015f) << "it creeps";
  EXPECT_NEAR(length(slid - start), 0.04f, 1e-3);
}

TEST(FootLock, a_planted_foot_creeps_to_where_the_style_wants_it) {
  // The style takes it 6 cm aside within a second, and leaves it there for nine.
  Sliding body;
  const Vec3 start = body.step(0, 1, 1), wanted = start + Vec3{0.06f, 0, 0};
  Vec3 last = start;
  for (int f = 1; f <= 300; ++f) {
    const Vec3 toe = body.step(std::min(f, 30), 1, 1);
    EXPECT_GE(toe.x, last.x - 1e-4f) << f;
    EXPECT_LT(length(toe - last), 0.04f / 30 + 1e-4f) << f;
    last = toe;
  }
  EXPECT_LT(length(last - wanted), 0.011f) << "a little is left";
}

TEST(FootLock, a_planted_toe_goes_to_the_height_of_the_inputs_above_the_ground_under_it) {
  // The style's path climbs by 15 cm; a leg that is nearly straight follows by most of that.
  Sliding body;
  const Vec3 start = body.step(0, 1, 1);
  body.climb(0.15f);
  Vec3 last = start;
  for (int f = 0; f < 30; ++f) {
    const Vec3 toe = body.step(0, 1, 1);
    EXPECT_GE(toe.y, last.y - 1e-4f) << f;
    EXPECT_LT(toe.y - last.y, 0.06f) << f;
    last = toe;
  }
  EXPECT_GT(last.y - start.y, 0.12f);
  EXPECT_LT(last.y - start.y, 0.151f);
}

TEST(FootLock, a_released_foot_comes_back_without_a_jump) {
  Sliding body;
  for (int f = 0; f <= 20; ++f) body.step(f, 1, 1);
  Vec3 last = body.step(20, 1, 1);
  for (int f = 0; f < 30; ++f) {
    const Vec3 toe = body.step(20, 0, 1);
    EXPECT_LT(length(toe - last), 0.04f * 0.4f);
    last = toe;
  }
}

TEST(FootLock, a_foot_that_lands_moving_comes_to_rest_without_a_jerk) {
  // The foot slides 1 cm a frame; it is free for 10 frames, then planted for 20.
  Sliding body;
  std::vector<Vec3> toes;
  for (int f = 0; f < 30; ++f) toes.push_back(body.step(5 * f, f < 10 ? 0.0f : 1.0f, 1));
  const auto step = [&](int f) { return length(toes[f] - toes[f - 1]); };
  EXPECT_NEAR(step(9), 0.01f, 1e-4);
  // A hard stop would take all of its speed within a frame.
  EXPECT_GT(step(10), 0.003f);
  for (int f = 11; f < 14; ++f) EXPECT_LE(step(f), step(f - 1) + 1e-4f) << f;
  // From then on it follows the style by 2 cm/s at most.
  for (int f = 16; f < 19; ++f) EXPECT_LT(step(f), 0.02f / 30 + 3e-4f) << f;
}

TEST(FootLock, a_foot_pulled_too_far_trails_behind_without_a_jump) {
  // The body slides 80 cm, 4 mm a frame, and back; the foot that it pulls is never let go.
  Sliding body;
  const Vec3 start = body.step(0, 1, 1);
  Vec3 last = start;
  for (int f = 1; f <= 200; ++f) {
    const Vec3 toe = body.step(2 * f, 1, 1);
    EXPECT_LE(length(toe - last), 0.0041f) << f;
    last = toe;
  }
  EXPECT_NEAR(length(last - start), 0.8f - 0.22f, 6e-3);
  for (int f = 199; f >= -800; --f) last = body.step(2 * std::max(0, f), 1, 1);
  EXPECT_LT(length(last - start), 0.011f) << "it creeps back";
}

TEST(FootLock, a_foot_that_slides_in_the_input_is_let_go) {
  Sliding body;
  const Vec3 start = body.step_of_sliding_input(0, 1);
  Vec3 toe;
  for (int f = 1; f <= 30; ++f) toe = body.step_of_sliding_input(f, 1);
  EXPECT_LT(length(toe - start), 2e-3f) << "held for 6 cm";
  for (int f = 31; f <= 200; ++f) toe = body.step_of_sliding_input(f, 1);
  EXPECT_NEAR(toe.x - start.x, 0.4f, 2e-3);
}

// Whether a foot leaves or stands is told by the input's own time, whatever tempo a style plays it
// at: at 1.2 m/s it leaves, at 0.4 m/s it stands.
TEST(FootLock, a_tempo_neither_holds_a_foot_that_leaves_nor_lets_one_go_that_stands) {
  for (const float rate : {0.6f, 1.0f, 1.5f}) {
    Sliding leaving, standing;
    leaving.play_at(rate), standing.play_at(rate);
    for (int f = 0; f < 5; ++f) leaving.step_of_sliding_input(0, 1);
    const Vec3 start = leaving.step_of_input_at(1.2f, 0, 1);
    Vec3 left;
    for (int f = 1; f <= 6; ++f) left = leaving.step_of_input_at(1.2f, f, 1);
    EXPECT_GT(left.x - start.x, 0.6f * 1.2f * rate * 6 / 30) << rate;
    // It lands within the first frames, and is held for the next.
    for (int f = 0; f <= 3; ++f) standing.step_of_input_at(0.4f, f, 0);
    Vec3 landed, held;
    for (int f = 4; f <= 6; ++f) landed = standing.step_of_input_at(0.4f, f, 1);
    for (int f = 7; f <= 9; ++f) held = standing.step_of_input_at(0.4f, f, 1);
    EXPECT_LT(length(held - landed), 0.35f * 0.4f * rate * 3 / 30) << rate;
  }
}

// The contact comes late in a spin or a kick: the foot is on its way before it is told to be free.
TEST(FootLock, a_foot_that_leaves_fast_does_so_without_a_jump) {
  Sliding body;
  std::vector<Vec3> toes;
  std::vector<float> inputs;
  float at = 0, step = 0;
  for (int f = 0; f < 30; ++f) {
    if (f >= 10 && f < 20) step += 5;  // Up to 10 cm a frame, or 3 m/s.
    at += step;
    inputs.push_back(at * 0.002f);
    toes.push_back(body.step_of_sliding_input(static_cast<int>(at), 1));
  }
  for (size_t f = 2; f < toes.size(); ++f) {
    const float now = toes[f].x - toes[f - 1].x, before = toes[f - 1].x - toes[f - 2].x;
    EXPECT_LT(std::abs(now - before), 0.035f) << f << ": the input's is up to 1 cm";
    EXPECT_LT(std::abs(toes[f].x - toes[0].x - inputs[f]), 0.07f) << f;
  }
}

TEST(FootLock, a_foot_that_arrives_fast_is_not_stopped_in_its_way) {
  // 5 cm a frame, or 1.5 m/s, for ten frames with the contact of a standing foot; then it stands.
  Sliding body;
  std::vector<Vec3> toes;
  for (int f = 0; f <= 10; ++f) toes.push_back(body.step_of_sliding_input(25 * f, 1));
  for (size_t f = 2; f < toes.size(); ++f) {
    EXPECT_NEAR(toes[f].x - toes[f - 1].x, 0.05f, 1e-3) << f;
  }
  for (int f = 0; f < 5; ++f) toes.push_back(body.step_of_sliding_input(250, 1));
  EXPECT_NEAR(toes.back().x - toes[0].x, 0.5f, 0.02f);
}

TEST(FootLock, a_foot_that_a_style_moves_faster_than_it_lands_is_not_held) {
  // Over an input that stands; the contact comes after two frames.
  const auto travel = [](int millimetres) {
    Sliding body;
    Vec3 last = body.step(0, 0, 1), toe;
    for (int f = 1; f <= 5; ++f) {
      last = std::exchange(toe, body.step(millimetres / 2 * f, f < 2 ? 0.0f : 1.0f, 1));
    }
    return length(toe - last);
  };
  EXPECT_LT(travel(50), 0.02f) << "1.5 m/s: held";
  EXPECT_NEAR(travel(120), 0.12f, 3e-3f) << "3.6 m/s";
}

TEST(FootLock, a_toe_below_the_floor_is_drawn_up_planted_or_not) {
  Sliding free, planted, half;
  const float high = free.step(0, 0, 1).y, sunk = high + 0.03f;
  // Where the toe is when the body sinks until the toe is 3 cm below the floor. These legs are
  // nearly straight, so that they do not follow all of the way, but most of it.
  const float raised = free.step(1, 0, 1, sunk).y;
  EXPECT_GT(raised, -0.008f);
  EXPECT_LE(raised, 1e-4f);
  for (int f = 0; f < 5; ++f) planted.step(f, 0, 1, high);
  EXPECT_NEAR(planted.step(5, 1, 1, sunk).y, raised, 5e-3);
  EXPECT_NEAR(half.step(0, 0, 0.5f, sunk).y, (raised - 0.03f) / 2, 3e-3);
  EXPECT_NEAR(free.step(2, 0, 0, sunk).y, -0.03f, 1e-4);
}

TEST(FootLock, a_straight_leg_does_not_let_its_knee_fly) {
  // The target comes nearer to the hip by 1 mm at a time; the leg begins straight.
  const auto bend = [](float nearer) {
    HumanPositions joints{};
    for (const int side : {0, 1}) {
      const float x = side == 0 ? 0.1f : -0.1f;
      joints[index(kUpperLegs[side])] = {x, 0, 0};
      joints[index(kLowerLegs[side])] = {x, -0.4f, 0.001f};
      joints[index(kAnkles[side])] = {x, -0.8f, 0};
      joints[index(kToes[side])] = {x, -0.85f, 0.1f};
    }
    BodyPose body;
    body.joints = joints;
    for (Vec3& joint : body.joints) joint.y += 0.85f - nearer;  // So deep are the toes.
    body.joints[index(HumanJoint::left_toes)].y = body.joints[index(HumanJoint::right_toes)].y = 0;
    FootLock lock;
    BodyChange change;
    const float contacts[kFeet] = {0, 0};
    lock.step(body, joints, contacts, kUnlevelled, 1, 0, {1 / 60.0f, 1 / 60.0f}, change);
    return length(log_rotation(change.rotations[index(HumanJoint::left_upper_leg)]));
  };
  // All of 1 mm would bend it by acos(0.799 / 0.8) = 0.05 radians.
  EXPECT_LT(bend(0.001f), 0.02f);
  float last = 0;
  for (int mm = 1; mm < 100; ++mm) {
    const float now = bend(0.001f * static_cast<float>(mm));
    EXPECT_GE(now, last) << mm;
    EXPECT_LT(now - last, 0.02f) << mm;
    last = now;
  }
  EXPECT_GT(last, 0.3f);
}

TEST(FootLock, without_amount_nothing_changes) {
  Sliding locked;
  Vec3 toe;
  const Vec3 start = locked.step(0, 1, 0);
  for (int f = 1; f <= 20; ++f) toe = locked.step(f, 1, 0);
  EXPECT_NEAR(length(toe - start), 0.04f, 1e-4);
}

}  // namespace
}  // namespace panache
