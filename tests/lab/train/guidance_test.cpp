#include <filesystem>
#include <numeric>
#include <optional>

#include <gtest/gtest.h>

#include "body_tensor.h"
#include "known_recipes.h"
#include "make_styled_takes.h"
#include "takes/manifest.h"
#include "temporary_folder.h"
#include "train/classifier.h"
#include "train/export.h"
#include "train/guidance.h"
#include "train/matrix_products.h"
#include "train/statistics_guide.h"
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
  const auto swinging = [](float metres, float middle = 0) {
    torch::Tensor bodies = torch::zeros({1, kSequenceInstants, kHumanJoints, 3});
    bodies.select(2, index(HumanJoint::left_hand)).select(2, 1) =
        middle + metres * torch::arange(kSequenceInstants).sin();
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
    for (const std::string& name : names_) styles_.push_back({name, {name}, ""});
    set_.emplace(data_.takes, data_.pairings, names_, test::kPanache, false);
    motion_.emplace(data_.unlabelled, data_.takes, std::vector<int>{});
  }

  // `signature`: of old, or null.
  Guidance guidance_of(const Signature* signature, int guide_steps) const {
    std::vector<int> choice(set_->samples().size());
    std::iota(choice.begin(), choice.end(), 0);
    GuidanceSettings guides = test::kPanache.training.guidance;
    guides.guide_steps = guide_steps;
    return Guidance(*set_, choice, output_units(*set_, choice), *motion_,
                    train_guides(data_.takes, *set_, choice, names_, guides, 5),
                    {signature, nullptr}, test::kPanache.training.guidance,
                    test::kPanache.training.batch.input_clip);
  }

  TrainOptions options(int64_t steps) const {
    TrainOptions options(test::kPanache);
    options.settings.steps = steps;
    options.settings.predictor_steps = 0;
    options.settings.guidance.guide_steps = 20;
    return options;
  }

  const std::vector<std::string> names_ = {"old", "proud"};
  TrainingData data_;
  std::vector<StyleName> styles_;
  std::optional<SampleSet> set_;
  std::optional<UnlabelledMotion> motion_;
};

TEST_F(GuidanceTest, what_it_adds_falls_when_it_is_learnt) {
  const Guidance guidance = guidance_of(nullptr, 100);
  NetworkTrainer pose(network_shapes(*set_, 2)[0], test::kPanache.training.optimizer, 150, 1);
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

TEST_F(GuidanceTest, motion_is_played_at_the_tempo_that_real_takes_agree_on) {
  Signature signature;
  signature.change[kTempoTrait] = -30;
  signature.deviation[kTempoTrait] = 5;
  NetworkTrainer timing(network_shapes(*set_, 2)[1], test::kPanache.training.optimizer, 200, 1);
  Random random(3);
  EXPECT_EQ(guidance_of(&signature, 1).tempo_loss(timing, 1, random).item<float>(), 0);

  signature.certain[kTempoTrait] = true;
  const Guidance guidance = guidance_of(&signature, 1);
  Random same(4), again(4);
  const float before = guidance.tempo_loss(timing, 0.2, same).item<float>();
  EXPECT_GT(before, 0);
  // It comes in by and by.
  EXPECT_NEAR(guidance.tempo_loss(timing, 0.1, again).item<float>(), 0.5f * before, 1e-3f * before);
  for (int step = 0; step < 200; ++step) {
    timing.learn(guidance.tempo_loss(timing, 1, random));
  }
  EXPECT_LT(guidance.tempo_loss(timing, 1, random).item<float>(), 0.1f * before);
  // What it answers to all of the motion as "old", whose signature it is, and as "proud".
  const torch::Tensor windows = guidance.windows(8, random);
  const auto tempo = [&](std::vector<int64_t> group_sizes) {
    torch::NoGradGuard no_gradients;
    return timing.forward(windows, group_sizes, nullptr).mean().item<float>();
  };
  EXPECT_NEAR(tempo({windows.size(0), 0}), -0.3f, 0.07f);
  EXPECT_GT(tempo({0, windows.size(0)}), -0.15f);
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

TEST_F(GuidanceTest, the_contact_network_does_not_depend_on_the_guided_tempo) {
  const test::TemporaryFolder folder;
  const auto whole = train(data_, styles_, options(12));
  ASSERT_TRUE(whole.ok()) << whole.error().message;
  TrainOptions kept = options(12);
  kept.checkpoint = folder.path() + "model.safetensors";
  ASSERT_TRUE(train(data_, styles_, kept).ok());
  // Interrupted where the timing network was there whole and the contact network was not.
  std::filesystem::remove(kept.checkpoint + ".contact.checkpoint");
  const auto resumed = train(data_, styles_, kept);
  ASSERT_TRUE(resumed.ok()) << resumed.error().message;
  EXPECT_EQ(format_safetensors(resumed->model), format_safetensors(whole->model));
}

TEST_F(GuidanceTest, so_many_steps_are_guided_and_with_this_weight) {
  const auto trunk = [&](int every, float weight) {
    TrainOptions guided = options(12);
    guided.settings.guidance.every = every;
    guided.settings.guidance.weight = weight;
    const auto trained = train(data_, styles_, guided);
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

const std::vector<std::string> kClasses = {"old", "proud", "neutral"};

// The first second of a take. [1][kClassifiedPoses][21][3]
torch::Tensor bodies_of(const Take& take) {
  torch::Tensor bodies = torch::empty({1, kClassifiedPoses, kHumanJoints, 3});
  float* to = bodies.data_ptr<float>();
  for (int p = 0; p < kClassifiedPoses; ++p) {
    for (const Vec3& joint : take.body[p * kClassifiedSpacing]) {
      *to++ = joint.x, *to++ = joint.y, *to++ = joint.z;
    }
  }
  return bodies;
}

TEST(StatisticsGuide, knows_the_styles_of_other_takes_and_its_gradient_leads_to_them) {
  EXPECT_TRUE(prepare_matrix_products().ok());
  const std::vector<Take> takes = test::styled_takes(kClasses, {0, 1});
  std::vector<std::string> labels;
  for (const Take& take : takes) labels.push_back(take.row.style);
  const StatisticsGuide guide(takes, labels, kClasses);
  for (size_t c = 0; c < kClasses.size(); ++c) {
    const torch::Tensor bodies = bodies_of(test::styled_take(kClasses[c], "walk", 3));
    const auto loss = [&](size_t wanted) {
      return guide.loss(bodies, torch::tensor({static_cast<int64_t>(wanted)}), 0).item<float>();
    };
    for (size_t other = 0; other < kClasses.size(); ++other) {
      if (other == c) continue;
      EXPECT_LT(loss(c) + 1, loss(other)) << kClasses[c] << " for " << kClasses[other];
    }
  }

  torch::Tensor bodies = bodies_of(test::styled_take("neutral", "walk", 3)).set_requires_grad(true);
  const torch::Tensor wanted = torch::tensor({int64_t{0}});
  const torch::Tensor before = guide.loss(bodies, wanted, 0);
  before.backward();
  ASSERT_TRUE(bodies.grad().isfinite().all().item<bool>());
  const double slope = bodies.grad().square().sum().item<double>();
  EXPECT_GT(slope, 0);
  const torch::Tensor moved = (bodies - 0.1 / slope * bodies.grad()).detach();
  EXPECT_LT(guide.loss(moved, wanted, 0).item<double>(), before.item<double>() - 0.02);
}

TEST(MotionStatistics, of_a_body_at_rest_have_a_slope) {
  torch::Tensor bodies = bodies_of(test::styled_take("neutral", "walk", 0)).slice(1, 0, 1);
  bodies = bodies.repeat({1, kClassifiedPoses, 1, 1}).set_requires_grad(true);
  motion_statistics(bodies).sum().backward();
  EXPECT_TRUE(bodies.grad().isfinite().all().item<bool>());
}

TEST(LinearDiscriminant, puts_the_border_half_way_whatever_the_spread_across) {
  torch::manual_seed(1);
  const auto cloud = [](double x) {
    return torch::randn({400, 2}, torch::kFloat64) * torch::tensor({1.0, 5.0}, torch::kFloat64) +
           torch::tensor({x, 0.0}, torch::kFloat64);
  };
  const LinearDiscriminant found({cloud(-3), cloud(3)});
  const torch::Tensor left = torch::tensor({{-1.0, 8.0}, {1.0, 8.0}}, torch::kFloat64);
  const torch::Tensor scores = found.scores(left);
  EXPECT_GT((scores[0][0] - scores[0][1]).item<double>(), 1);
  EXPECT_GT((scores[1][1] - scores[1][0]).item<double>(), 1);
}

}  // namespace
}  // namespace panache
