#include "pose/foot_lock.h"

#include <vector>

#include <gtest/gtest.h>

#include "base/random.h"
#include "make_clip.h"

namespace panache {
namespace {

constexpr Vec3 kHip{0, 0.9f, 0}, kKnee{0, 0.48f, 0.05f}, kAnkle{0, 0.08f, 0};

Vec3 reached(const TwoBoneTurn& turn, Vec3 hip, Vec3 knee, Vec3 ankle) {
  return hip + rotate(turn.upper, knee - hip) + rotate(turn.lower, ankle - knee);
}

TEST(TwoBoneIk, a_target_in_reach_is_met_and_the_knee_keeps_its_side) {
  Random random(7);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 target = kAnkle + Vec3{0.2f * random.normal(), 0.05f + 0.1f * random.uniform(),
                                      0.2f * random.normal()};
    if (length(target - kHip) > 0.8f) continue;
    const TwoBoneTurn turn = two_bone_ik(kHip, kKnee, kAnkle, target, {0, 0, 1});
    EXPECT_LT(length(reached(turn, kHip, kKnee, kAnkle) - target), 1e-4f);
    const Vec3 knee = kHip + rotate(turn.upper, kKnee - kHip);
    EXPECT_GT(knee.z, (kHip.z + target.z) / 2 - 0.02f) << "the knee bends backwards";
  }
}

TEST(TwoBoneIk, a_target_at_the_end_itself_turns_nothing) {
  const TwoBoneTurn turn = two_bone_ik(kHip, kKnee, kAnkle, kAnkle, {0, 0, 1});
  EXPECT_LT(length(turn.upper.xyz()), 1e-3f);
  EXPECT_LT(length(turn.lower.xyz()), 1e-3f);
}

TEST(TwoBoneIk, a_target_out_of_reach_is_approached_and_stays_finite) {
  for (const Vec3 target : {Vec3{0, -5, 0}, Vec3{9, 0, 9}, kHip, Vec3{1e20f, 0, 0}}) {
    const TwoBoneTurn turn = two_bone_ik(kHip, kKnee, kAnkle, target, {0, 0, 1});
    EXPECT_TRUE(is_finite(turn.upper) && is_finite(turn.lower));
    const float reach = length(reached(turn, kHip, kKnee, kAnkle) - kHip);
    EXPECT_LE(reach, 0.83f);
  }
}

// A standing body whose style pushes the hips sideways: the planted foot must stay.
class Sliding {
 public:
  Sliding() : clip_(test::walking_clip(1)), rig_(*Rig::create(clip_)) {
    rig_.read(clip_.pose(0), body_);
  }
  // World position of the left toe once the change of frame f is locked.
  Vec3 step(int f, float contact, float amount) {
    BodyChange change;
    change.translation = {0.002f * static_cast<float>(f), 0, 0};
    const float contacts[kFeet] = {contact, 0};
    lock_.step(body_, contacts, amount, 1 / 30.0f, change);
    HumanPositions joints;
    changed_joints(body_, change, joints);
    const Vec3 toe = joints[index(HumanJoint::left_toes)];
    return mid_hip(body_) + change.translation + rotate(rotation_y(body_.facing), toe);
  }

 private:
  Clip clip_;
  Rig rig_;
  BodyPose body_;
  FootLock lock_;
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
  EXPECT_LT(length(held - start), 0.002f);
  EXPECT_NEAR(length(slid - start), 0.04f, 1e-3);
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
  const auto way = [&](int f) { return length(toes[f] - toes[f - 1]); };
  EXPECT_NEAR(way(9), 0.01f, 1e-4);
  // A hard stop would take all of its speed within a frame.
  EXPECT_GT(way(10), 0.003f);
  for (int f = 11; f < 21; ++f) EXPECT_LE(way(f), way(f - 1) + 1e-4f) << f;
  EXPECT_LT(way(16), 0.001f) << "and it stands within a fifth of a second";
}

TEST(FootLock, a_foot_pulled_too_far_is_let_go) {
  Sliding body;
  const Vec3 start = body.step(0, 1, 1);
  Vec3 toe;
  for (int f = 1; f <= 200; ++f) toe = body.step(f, 1, 1);
  EXPECT_GT(length(toe - start), 0.3f);
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
