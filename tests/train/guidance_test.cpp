#include "train/guidance.h"

#include <gtest/gtest.h>

#include "body_tensor.h"
#include "known_recipes.h"
#include "make_styled_takes.h"
#include "train/export.h"
#include "train/matrix_products.h"
#include "train/trainer.h"

namespace panache {
namespace {

using test::as_tensor;

TEST(TraitChanges, are_differences_of_traits) {
  // Fifteen instants, two frames apart: what traits() sees of each frame, both see.
  const auto instants = [](const Take& take) {
    torch::Tensor bodies = torch::empty({1, kSequenceInstants, kHumanJoints, 3});
    for (int i = 0; i < kSequenceInstants; ++i) {
      bodies[0][i] = as_tensor(take.body[i * kClassifiedSpacing]);
    }
    return bodies;
  };
  const auto every_second = [](Take take) {
    for (int i = 0; i < kSequenceInstants; ++i) take.body[i] = take.body[i * kClassifiedSpacing];
    take.body.resize(kSequenceInstants);
    return take;
  };
  const Take neutral = test::styled_take("neutral", "walk", 0);
  const Take old = test::styled_take("old", "wave", 0);
  const Traits before = traits(every_second(neutral)), after = traits(every_second(old));
  const torch::Tensor found = trait_changes(instants(neutral), instants(old));
  for (int t = 0; t < kGuidedTraits - 1; ++t) {
    // A straight elbow counts as bent by some tenths, so that it has a slope.
    EXPECT_NEAR(found[0][t].item<double>(), after[t] - before[t], 0.2) << kTraits[t].key;
  }
  // Twice the time between the instants: the speed above rest differs, its sign does not.
  EXPECT_GT(found[0][kGuidedTraits - 1].item<double>() * (after[6] - before[6]), 0);
}

TEST(VelocityLoss, movement_that_differs_or_shrinks_costs) {
  // A hand that swings by so many metres about any place.
  const auto swinging = [](float metres, float place = 0) {
    torch::Tensor bodies = torch::zeros({1, kSequenceInstants, kHumanJoints, 3});
    bodies.select(2, index(HumanJoint::left_hand)).select(2, 1) =
        place + metres * torch::arange(kSequenceInstants).sin();
    return bodies;
  };
  const auto loss = [&](const torch::Tensor& out) {
    return velocity_loss(swinging(0.1f), out).item<float>();
  };
  EXPECT_NEAR(loss(swinging(0.1f)), 0, 0.01f);
  EXPECT_NEAR(loss(swinging(0.1f, 1)), 0, 0.01f);
  EXPECT_NEAR(loss(swinging(0.2f)), 0, 0.01f);
  EXPECT_NEAR(loss(swinging(0.05f)), 0.5f, 0.01f);
  EXPECT_NEAR(loss(swinging(0)), 1, 0.01f);
  EXPECT_NEAR(loss(swinging(-0.1f)), 2, 0.01f);
}

// Walks in two styles, and waving that nobody showed in any.
class GuidanceTest : public testing::Test {
 protected:
  GuidanceTest() {
    EXPECT_TRUE(prepare_matrix_products().ok());
    for (const Take& take : test::styled_takes({"neutral", "old", "proud"}, {0, 1})) {
      if (take.row.content == "walk") {
        data_.takes.push_back(take);
      } else if (take.row.neutral) {
        data_.unlabelled.push_back(take);
      }
    }
    std::vector<int> styled, neutral;
    for (size_t i = 0; i < data_.takes.size(); ++i) {
      (data_.takes[i].row.neutral ? neutral : styled).push_back(static_cast<int>(i));
    }
    data_.pairings = pair_takes(data_.takes, styled, neutral);
    for (const char* name : {"old", "proud"}) styles_.push_back({name, {name}, ""});
  }

  TrainOptions options(int64_t steps) const {
    TrainOptions options(test::kPanache);
    options.settings.steps = steps;
    options.settings.predictor_steps = 0;
    options.settings.guidance.guide_steps = 20;
    return options;
  }

  TrainingData data_;
  std::vector<StyleName> styles_;
};

TEST_F(GuidanceTest, what_it_adds_falls_when_it_is_learnt) {
  const Recipe& recipe = test::kPanache;
  const SampleSet set(data_.takes, data_.pairings, {"old", "proud"}, recipe, false);
  std::vector<int> choice(set.samples().size());
  for (size_t i = 0; i < choice.size(); ++i) choice[i] = static_cast<int>(i);
  const OutputUnits units = output_units(set, choice);
  const UnlabelledMotion motion(data_.unlabelled, data_.takes, {});
  GuidanceSettings guides = recipe.training.guidance;
  guides.guide_steps = 100;
  const Guidance guidance(set, choice, units, motion,
                          train_guides(data_.takes, set, choice, {"old", "proud"}, guides, 5),
                          {nullptr, nullptr}, recipe.training.guidance,
                          recipe.training.batch.input_clip);
  NetworkTrainer pose(network_shapes(set, 2)[0], recipe.training.optimizer, 150, 1);
  const auto mean_loss = [&] {
    torch::NoGradGuard no_gradients;
    Random random(9);
    float sum = 0;
    for (int i = 0; i < 8; ++i) sum += guidance.loss(pose, 1, random).item<float>() / 8;
    return sum;
  };
  const float before = mean_loss();
  Random random(3);
  for (int step = 0; step < 150; ++step) pose.learn(guidance.loss(pose, 1, random));
  EXPECT_LT(mean_loss(), 0.6f * before);

  // It comes in by and by.
  Random same(4), again(4);
  const float whole = guidance.loss(pose, 0.2, same).item<float>();
  EXPECT_NEAR(guidance.loss(pose, 0.1, again).item<float>(), 0.5f * whole, 1e-3f * whole);
}

TEST_F(GuidanceTest, the_same_seed_gives_the_same_model_and_other_motion_another) {
  const auto bytes = [&](const TrainingData& data) {
    const auto trained = train(data, styles_, options(12));
    EXPECT_TRUE(trained.ok()) << trained.error().message;
    return format_safetensors(trained->model);
  };
  const std::string once = bytes(data_);
  EXPECT_EQ(bytes(data_), once);
  TrainingData other = data_;
  other.unlabelled.pop_back();
  EXPECT_NE(bytes(other), once);
}

TEST_F(GuidanceTest, so_many_steps_are_guided_and_with_this_weight) {
  const auto trunk = [&](int every, float weight) {
    TrainOptions how = options(12);
    how.settings.guidance.every = every;
    how.settings.guidance.weight = weight;
    const auto trained = train(data_, styles_, how);
    EXPECT_TRUE(trained.ok()) << trained.error().message;
    return trained->model.tensors.at("pose.trunk.0.weight").values;
  };
  const std::vector<float> unguided = trunk(1, 0);
  // Step 0 alone, at which guidance has not come in yet.
  EXPECT_EQ(trunk(12, 1), unguided);
  const std::vector<float> all = trunk(1, 1), half = trunk(2, 1);
  EXPECT_NE(half, unguided);
  EXPECT_NE(half, all);
  EXPECT_NE(trunk(2, 2), half);
}

TEST_F(GuidanceTest, motion_that_is_too_short_is_rejected) {
  data_.unlabelled = {test::styled_take("neutral", "wave", 0, 30)};
  const auto trained = train(data_, styles_, options(5));
  ASSERT_FALSE(trained.ok());
  EXPECT_EQ(trained.error().message,
            "the unlabelled motion is too short; expected a take of more than 1.5 seconds");
}

}  // namespace
}  // namespace panache
