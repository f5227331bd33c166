#include "train/styled_bodies.h"

#include <gtest/gtest.h>

#include "pose/contacts.h"
#include "rig/humanoid.h"

namespace panache {
namespace {

constexpr int kInstants = 15;
constexpr float kStep = 2.0f / 30;  // Seconds between instants.

// A body whose joints are all at its hips but for its feet, which stand beside them.
struct Motion {
  torch::Tensor bodies = torch::zeros({1, kInstants, kHumanJoints, 3});
  torch::Tensor root = torch::zeros({1, kInstants, 3});

  Motion() {
    for (int f = 0; f < kFeet; ++f) {
      bodies.select(2, index(kToes[f])).select(2, 0).fill_(f == 0 ? 0.2f : -0.2f);
    }
  }
  // Moves a toe along an axis at so many m/s.
  Motion& move(int foot, int axis, float speed) {
    const torch::Tensor way = speed * kStep * torch::arange(kInstants);
    bodies.select(2, index(kToes[foot])).select(2, axis).add_(way);
    return *this;
  }
  Motion& raise(int foot, float metres) {
    bodies.select(2, index(kToes[foot])).select(2, 1).add_(metres);
    return *this;
  }
};

float loss_of(const Motion& in, const Motion& out,
              const torch::Tensor& root_change = torch::zeros({1, kInstants, 3})) {
  return standing_loss(in.bodies, out.bodies, in.root, root_change).item<float>();
}
// What a toe costs that moves so fast.
float cost(float speed) {
  const float moved = speed / 0.2f;
  return moved * moved / (1 + moved);
}

TEST(StandingLoss, feet_may_stand_elsewhere_but_not_move) {
  Motion wider;
  wider.bodies.select(2, index(kToes[0])).select(2, 0).add_(0.05f);
  EXPECT_NEAR(loss_of({}, wider), 0, 1e-3f);
  // The other foot is in the air, so that only one stands.
  const Motion input = Motion().raise(1, 0.1f);
  const auto moved = [&](int axis, float speed) {
    return loss_of(input, Motion().raise(1, 0.1f).move(0, axis, speed));
  };
  for (const int axis : {0, 1, 2}) EXPECT_NEAR(moved(axis, 0.3f), cost(0.3f), 0.01f);
  // Far out the cost grows evenly.
  const float fast = moved(2, 4), faster = moved(2, 8);
  EXPECT_NEAR(faster / fast, 2, 0.1f);
}

TEST(StandingLoss, feet_that_stand_together_keep_their_stance) {
  // 14 cm more than what is free, in units of 10 cm.
  for (const int axis : {0, 2}) {
    Motion apart;
    apart.bodies.select(2, index(kToes[0])).select(2, axis).add_(0.2f);
    EXPECT_NEAR(loss_of({}, apart), 1.4f * 1.4f / 2.4f, 0.01f) << axis;
  }
  // With one in the air it is a step.
  Motion step = Motion().raise(1, 0.1f);
  step.bodies.select(2, index(kToes[0])).select(2, 2).add_(0.4f);
  EXPECT_NEAR(loss_of(Motion().raise(1, 0.1f), step), 0, 1e-3f);
}

TEST(StandingLoss, feet_that_move_in_the_input_are_free) {
  const Motion input = Motion().move(0, 2, 0.4f);
  EXPECT_NEAR(loss_of(input, Motion().move(0, 2, 3)), 0, 1e-3f);
  // A foot in the air that hangs still.
  EXPECT_NEAR(loss_of(Motion().raise(0, 0.06f), Motion().raise(0, 0.06f).move(0, 2, 1)), 0, 1e-3f);
  EXPECT_GT(loss_of(Motion().raise(0, 0.04f), Motion().raise(0, 0.04f).move(0, 2, 1)), 1);
}

TEST(StandingLoss, over_the_ground_and_not_beside_the_body) {
  // Walking ahead at 1 m/s with one foot on the ground: below the body it moves back.
  Motion walk = Motion().move(0, 2, -1).raise(1, 0.1f);
  walk.root.select(2, 1).fill_(1);
  EXPECT_NEAR(loss_of(walk, walk), 0, 1e-3f);
  Motion faster = Motion().move(0, 2, -1.5f).raise(1, 0.1f);
  EXPECT_NEAR(loss_of(walk, faster), cost(0.5f), 0.02f);
  torch::Tensor change = torch::zeros({1, kInstants, 3});
  change.select(2, 1).fill_(0.5f);
  EXPECT_NEAR(loss_of(walk, faster, change), 0, 0.01f);

  // On the spot the live step adds no root motion.
  EXPECT_NEAR(loss_of({}, {}, change), 0, 1e-3f);

  // Turning to the left, a toe to the left of the body and one to its right stay where they are.
  Motion turning = Motion().move(0, 2, 0.2f * 0.5f).move(1, 2, -0.2f * 0.5f);
  turning.root.select(2, 2).fill_(0.5f);
  EXPECT_NEAR(loss_of(turning, turning), 0, 1e-3f);
  // Both toes slide, and their stance turns away.
  EXPECT_GT(loss_of(turning, Motion()), cost(0.1f));
}

}  // namespace
}  // namespace panache
