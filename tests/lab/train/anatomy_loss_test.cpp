#include "train/styled_bodies.h"

#include <vector>

#include <gtest/gtest.h>

#include "body_tensor.h"
#include "make_styled_takes.h"
#include "posed_body.h"
#include "rig/beyond_range.h"

namespace panache {
namespace {

using namespace test;
using enum HumanJoint;

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

}  // namespace
}  // namespace panache
