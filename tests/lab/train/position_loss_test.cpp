#include "train/styled_bodies.h"

#include <cmath>

#include <gtest/gtest.h>

#include "known_recipes.h"
#include "make_styled_takes.h"
#include "train/matrix_products.h"

namespace panache {
namespace {

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

}  // namespace
}  // namespace panache
