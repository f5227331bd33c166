// The body that comes of a change, and the losses on it.

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "base/random.h"
#include "body_tensor.h"
#include "known_recipes.h"
#include "make_styled_takes.h"
#include "pose/contacts.h"
#include "posed_body.h"
#include "rig/beyond_range.h"
#include "rig/humanoid.h"
#include "style/stages/shaping.h"
#include "train/matrix_products.h"
#include "train/styled_bodies.h"

namespace panache {
namespace {

using test::as_tensor;

TEST(StyledBodies, are_those_of_the_live_step) {
  const Take take = test::styled_take("neutral", "walk", 0);
  Random random(7);
  for (int f = 0; f < take.frames(); f += 10) {
    StyleDelta delta;
    for (Vec3& r : delta.rotations) r = {random.normal(), random.normal(), random.normal()};
    delta.rotations[3] = {};  // The formula has no angle to divide by.
    delta.hips_height = 0.1f;
    std::array<float, StyleDelta::kSize> packed;
    pack(delta, packed);
    const HumanPositions expected = change_body(take.body[f], delta);
    const torch::Tensor made =
        styled_bodies(as_tensor(take.body[f]).unsqueeze(0),
                      torch::from_blob(packed.data(), {1, StyleDelta::kSize}));
    EXPECT_LT((made[0] - as_tensor(expected)).abs().max().item<float>(), 1e-5f) << f;
  }
}

using enum HumanJoint;

// A batch of walks in a style.
class PositionLossTest : public testing::Test {
 protected:
  PositionLossTest()
      : takes_(test::styled_takes({"neutral", "old"}, {0})),
        pairings_(pair_takes(takes_, indices(false), indices(true))),
        set_(takes_, pairings_, {"old"}, test::kPanache, false),
        units_(output_units(set_, {})),
        loss_(set_, units_),
        batch_(BatchMaker(set_, {}, 1, {}, units_).plain({0, 1, 2})) {
    EXPECT_TRUE(prepare_matrix_products().ok());
  }

  std::vector<int> indices(bool neutral) const {
    std::vector<int> found;
    for (size_t i = 0; i < takes_.size(); ++i) {
      if (takes_[i].row.neutral == neutral) found.push_back(static_cast<int>(i));
    }
    return found;
  }
  // The pairs' answers with so much more of a number in the middle row of three.
  float loss_of_more(int number, float more) const {
    torch::Tensor answers = batch_.pose.clone();
    answers[1][number] += more / units_.scale[number];
    return loss_(answers, batch_).item<float>();
  }

  std::vector<Take> takes_;
  std::vector<Pairing> pairings_;
  SampleSet set_;
  OutputUnits units_;
  PositionLoss loss_;
  Batch batch_;
};

TEST_F(PositionLossTest, what_the_pairs_show_costs_nothing) {
  EXPECT_EQ(loss_(batch_.pose, batch_).item<float>(), 0);
}

TEST_F(PositionLossTest, all_joints_are_off_where_the_hips_are_too_high) {
  EXPECT_NEAR(loss_of_more(kHipsHeight, 0.1f), 1.0f / 3, 1e-4f);
  EXPECT_NEAR(loss_of_more(kHipsHeight, -0.2f), 4.0f / 3, 1e-4f);
}

TEST_F(PositionLossTest, a_joint_that_is_turned_takes_along_what_hangs_on_it) {
  const auto off = [&](HumanJoint joint) { return loss_of_more(3 * index(joint), 1.5f); };
  EXPECT_EQ(off(left_hand), 0);  // The end of a limb.
  EXPECT_GT(off(left_lower_arm), 0.05f);
  // The bones are about as long, and two joints hang on the upper one.
  EXPECT_NEAR(off(left_upper_arm), 2 * off(left_lower_arm), off(left_lower_arm));
}

TEST_F(PositionLossTest, the_body_is_that_of_the_window) {
  // Where nothing is to change, a forearm that is turned by 1 rad puts the hand this far off.
  Batch still = batch_;
  still.pose = torch::zeros_like(batch_.pose);
  torch::Tensor answers = torch::zeros_like(batch_.pose);
  const int number = 3 * index(left_lower_arm);
  answers[1][number] = 1 / units_.scale[number];
  const Sample& sample = set_.samples()[1];
  const HumanPositions& body = takes_[sample.take].body[static_cast<size_t>(sample.frame)];
  const Vec3 bone = body[index(left_hand)] - body[index(left_lower_arm)];
  const float off = 2 * std::sin(0.5f) * std::hypot(bone.y, bone.z);
  EXPECT_NEAR(loss_(answers, still).item<float>(), off * off / 0.01f / kHumanJoints / 3, 1e-4f);
}

TEST_F(PositionLossTest, roots_of_bodies_do_not_count) {
  EXPECT_EQ(loss_of_more(kHipsHeight + 1, 3), 0);  // Velocities and the turn rate.
  EXPECT_EQ(loss_of_more(kHipsHeight + 3, 3), 0);
}

using namespace test;

torch::Tensor as_rows(const std::vector<HumanPositions>& bodies) {
  std::vector<torch::Tensor> rows;
  for (const HumanPositions& body : bodies) rows.push_back(as_tensor(body));
  return torch::stack(rows);
}
float loss_of(const std::vector<Turn>& before, const std::vector<Turn>& after) {
  return anatomy_loss(as_rows({posed(before)}), as_rows({posed(after)})).item<float>();
}
// What one joint costs that goes this many degrees beyond its range.
float cost(float degrees) { return degrees * degrees / 100 / (1 + degrees / 10); }

TEST(AnatomyLoss, what_people_do_is_free) {
  EXPECT_EQ(loss_of({}, {}), 0);
  EXPECT_EQ(loss_of({}, {{left_upper_leg, kX, -90},
                         {right_upper_leg, kX, -90},
                         {left_lower_leg, kX, 90},
                         {right_lower_leg, kX, 90}}),
            0);
  EXPECT_EQ(loss_of({}, {{left_upper_arm, kX, -175}, {right_upper_arm, kZ, -170}}), 0);
  EXPECT_EQ(loss_of({}, {{left_upper_arm, kX, 40}, {left_lower_arm, kElbowAxis, 90}}), 0);
  const Take walk = styled_take("old", "walk", 0);
  EXPECT_EQ(anatomy_loss(as_rows({walk.body[0]}), as_rows({walk.body[20]})).item<float>(), 0);
}

TEST(AnatomyLoss, every_joint_costs_by_how_far_it_is_beyond_its_range) {
  const auto expect_cost = [](const std::vector<Turn>& turns, float degrees) {
    // Trunk and neck are resampled from positions: they lean by some degrees at rest.
    EXPECT_NEAR(loss_of({}, turns), cost(degrees), 0.6f)
        << human_joint_name(index(turns.back().joint));
  };
  expect_cost({{left_upper_leg, kX, 70}}, 70 - kHipRange.back);
  expect_cost({{left_upper_leg, kZ, 85}}, 85 - kHipRange.out);
  expect_cost({{left_upper_leg, kZ, -70}}, 70 - kHipRange.in);
  expect_cost({{right_upper_leg, kZ, 70}}, 70 - kHipRange.in);
  expect_cost({{right_upper_arm, kX, 110}}, 110 - kShoulderRange.back);
  expect_cost({{neck, kX, 90}}, 90 - kHeadRange.front);
  expect_cost({{right_lower_leg, kX, 170}}, 170 - kKneeRange.max);
  expect_cost({{left_lower_leg, kX, -60}}, 60 - kKneeRange.back);
  expect_cost({{left_upper_leg, kX, -100}, {left_lower_leg, kX, -70}}, 70 - kKneeRange.back);
  expect_cost({{left_lower_arm, kElbowAxis, -70}}, 70 - kElbowRange.back);
  expect_cost({{right_lower_arm, kElbowAxis, 70}}, 70 - kElbowRange.back);
  expect_cost({{spine, kX, -70}}, 70 - kTorsoRange.back);
}

TEST(AnatomyLoss, what_the_input_does_itself_is_free) {
  const std::vector<Turn> split = {{left_upper_leg, kZ, 100}};
  EXPECT_GT(loss_of({}, split), 3);
  EXPECT_EQ(loss_of(split, split), 0);
  EXPECT_EQ(loss_of({{left_upper_leg, kZ, 110}}, split), 0);
}

TEST(AnatomyLoss, rows_count_alike_and_joints_add_up) {
  const HumanPositions rest = posed({});
  const HumanPositions one = posed({{left_lower_leg, kX, -60}});
  const HumanPositions both = posed({{left_lower_leg, kX, -60}, {right_lower_leg, kX, -60}});
  const auto loss = [&](const std::vector<HumanPositions>& out) {
    return anatomy_loss(as_rows(std::vector<HumanPositions>(out.size(), rest)), as_rows(out))
        .item<float>();
  };
  EXPECT_NEAR(loss({both}), 2 * loss({one}), 1e-3f);
  EXPECT_NEAR(loss({one, rest}), loss({one}) / 2, 1e-3f);
}

TEST(AnatomyLoss, its_slope_leads_back_and_is_finite_everywhere) {
  const torch::Tensor in = as_rows({posed({})});
  for (const std::vector<Turn>& turns :
       {std::vector<Turn>{}, {{left_upper_leg, kX, 70}}, {{left_lower_leg, kX, 180}}}) {
    torch::Tensor out = as_rows({posed(turns)}).requires_grad_();
    anatomy_loss(in, out).backward();
    EXPECT_TRUE(out.grad().isfinite().all().item<bool>());
  }
  torch::Tensor out = as_rows({posed({{left_upper_leg, kX, 70}})}).requires_grad_();
  const float before = anatomy_loss(in, out).item<float>();
  for (int step = 0; step < 50; ++step) {
    const torch::Tensor loss = anatomy_loss(in, out);
    if (out.grad().defined()) out.grad().zero_();
    loss.backward();
    torch::NoGradGuard no_gradients;
    out -= 0.001 * out.grad();
  }
  EXPECT_LT(anatomy_loss(in, out).item<float>(), 0.2f * before);
}

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
    const torch::Tensor path = speed * kStep * torch::arange(kInstants);
    bodies.select(2, index(kToes[foot])).select(2, axis).add_(path);
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
float cost_of_speed(float speed) {
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
  for (const int axis : {0, 1, 2}) EXPECT_NEAR(moved(axis, 0.3f), cost_of_speed(0.3f), 0.01f);
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
  EXPECT_NEAR(loss_of(walk, faster), cost_of_speed(0.5f), 0.02f);
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
  EXPECT_GT(loss_of(turning, Motion()), cost_of_speed(0.1f));
}

}  // namespace
}  // namespace panache
