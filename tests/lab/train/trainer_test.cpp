#include "train/trainer.h"

#include <cmath>
#include <filesystem>

#include <gtest/gtest.h>
#include <torch/serialize.h>

#include "known_recipes.h"
#include "make_manifest.h"
#include "style/networks/networks.h"
#include "takes/manifest.h"
#include "temporary_folder.h"
#include "train/checkpoint.h"
#include "train/export.h"

namespace panache {
namespace {

// Two takes made by a formula, written as files: a neutral walk and one that leans forward.
class TrainerTest : public testing::Test {
 protected:
  TrainerTest() {
    test::write_manifest(folder_);
    rows_ = *read_manifest(folder_ + "manifest.csv", 0);
    EXPECT_TRUE(apply_style_names(styles_, rows_).ok());
  }

  TrainOptions options(const Recipe& recipe, int64_t steps) const {
    TrainOptions options(recipe);
    options.settings.steps = steps;
    options.settings.predictor_steps = 0;  // Has tests of its own.
    return options;
  }

  const test::TemporaryFolder temporary_;
  const std::string folder_ = temporary_.path();
  std::vector<ManifestRow> rows_;
  std::vector<StyleName> styles_;
};

TEST_F(TrainerTest, both_recipes_learn_and_the_export_is_libtorchs_forward_pass) {
  for (const Recipe* recipe : {&test::kPanache, &test::kSmith2019}) {
    const auto trained = train(rows_, styles_, options(*recipe, 200));
    ASSERT_TRUE(trained.ok()) << trained.error().message;
    // Sums of a few hundred products in another order: single precision's share of 1e-7 each.
    EXPECT_LT(trained->export_error, 1e-4f);
    float first = -1, last = -1;
    for (const LossPoint& point : trained->losses) {
      if (point.network != "pose") continue;
      if (first < 0) first = point.train;
      last = point.train;
    }
    EXPECT_LT(last, 0.5f * first);
  }
}

TEST(Export, a_model_has_the_groups_of_the_table_of_styles_if_it_names_any) {
  std::vector<StyleName> styles = {{"sad", {"sad"}, "hanging head", "moods"}, {"old", {"old"}, ""}};
  const auto metadata = model_metadata(test::kPanache, styles);
  EXPECT_EQ(metadata.at("styles"), "sad\nold\n");
  EXPECT_EQ(metadata.at("style_descriptions"), "hanging head\n\n");
  EXPECT_EQ(metadata.at("style_groups"), "moods\n\n");
  styles[0].group.clear();
  EXPECT_FALSE(model_metadata(test::kPanache, styles).contains("style_groups"));
}

TEST_F(TrainerTest, the_same_seed_gives_the_same_model_and_another_another) {
  TrainOptions same = options(test::kPanache, 40), other = same;
  other.seed = 2;
  const std::string a = format_safetensors(train(rows_, styles_, same)->model);
  EXPECT_EQ(a, format_safetensors(train(rows_, styles_, same)->model));
  EXPECT_NE(a, format_safetensors(train(rows_, styles_, other)->model));
}

TEST_F(TrainerTest, where_the_joints_end_counts) {
  TrainOptions with = options(test::kPanache, 20), without = with;
  without.settings.positions = 0;
  const auto pose_loss = [&](const TrainOptions& options) {
    const auto trained = train(rows_, styles_, options);
    float last = -1;
    for (const LossPoint& point : trained->losses) {
      if (point.network == "pose") last = point.train;
    }
    return last;
  };
  // What is reported is the squared error alone, so that recipes can be compared: with another loss
  // beside it, it falls otherwise.
  EXPECT_GT(with.settings.positions, 0);
  EXPECT_NE(pose_loss(with), pose_loss(without));
}

TEST_F(TrainerTest, interrupted_training_goes_on_as_if_it_had_not_been) {
  TrainOptions whole = options(test::kPanache, 40);
  const auto uninterrupted = train(rows_, styles_, whole);
  TrainOptions with_checkpoints = whole;
  with_checkpoints.checkpoint = folder_ + "model.safetensors";
  ASSERT_TRUE(train(rows_, styles_, with_checkpoints).ok());
  // The last checkpoint is of the last step: going on from it does nothing but export.
  const auto resumed = train(rows_, styles_, with_checkpoints);
  ASSERT_TRUE(resumed.ok()) << resumed.error().message;
  EXPECT_EQ(format_safetensors(uninterrupted->model), format_safetensors(resumed->model));
  EXPECT_EQ(resumed->losses.size(), uninterrupted->losses.size());

  // Interrupted between the checkpoints of two networks that share their batches: the timing
  // network is there whole, the contact network starts anew, and both end as if nothing had
  // happened.
  std::filesystem::remove(with_checkpoints.checkpoint + ".contact.checkpoint");
  const auto half = train(rows_, styles_, with_checkpoints);
  ASSERT_TRUE(half.ok()) << half.error().message;
  EXPECT_EQ(format_safetensors(uninterrupted->model), format_safetensors(half->model));
  EXPECT_EQ(half->losses.size(), uninterrupted->losses.size());

  remove_checkpoints(with_checkpoints.checkpoint);
  EXPECT_FALSE(std::filesystem::exists(with_checkpoints.checkpoint + ".pose.checkpoint"));
}

TEST_F(TrainerTest, training_does_not_go_on_from_a_checkpoint_of_another) {
  TrainOptions begun = options(test::kPanache, 5);
  begun.checkpoint = folder_ + "model.safetensors";
  ASSERT_TRUE(train(rows_, styles_, begun).ok());
  const auto rejection = [&](const std::vector<StyleName>& styles, const TrainOptions& options) {
    const auto trained = train(rows_, styles, options);
    return trained.ok() ? "" : trained.error().message;
  };
  const auto expected = [&](const std::string& what) {
    return begun.checkpoint + ".pose.checkpoint: was begun with other " + what +
           "; delete it to train from the start, or train with the " + what + " as before";
  };
  EXPECT_EQ(rejection(styles_, begun), "");

  std::vector<TrainOptions> others(9, begun);
  others[0].seed = 9;
  others[1].settings.steps = 6;
  others[2].settings.batch.size = 128;
  others[3].settings.batch.disturbance.jitter = 0;
  others[4].settings.optimizer.learning_rate = 0.001f;
  others[5].settings.smoothness = 0;
  others[6].settings.positions = 0;
  others[7].settings.guidance.standing = 0;
  others[8].settings.guidance.tempo = 0;
  for (size_t i = 0; i < others.size(); ++i) {
    EXPECT_EQ(rejection(styles_, others[i]), expected("settings")) << i;
  }

  std::vector<StyleName> renamed = styles_;
  renamed[0].name = "aged";
  rows_[1].style = "aged";
  EXPECT_EQ(rejection(renamed, begun), expected("styles"));
  rows_[1].style = "old";

  // As many frames and samples as before, and in one of them an arm is somewhere else.
  Clip neutral = test::walking_clip(150);
  neutral.pose(75).rotations[index(HumanJoint::left_upper_arm)] = axis_angle(Vec3{1, 0, 0}, 0.3f);
  ASSERT_TRUE(write_file(folder_ + "neutral.bvh", format_bvh(neutral), true).ok());
  EXPECT_EQ(rejection(styles_, begun), expected("data"));
}

TEST_F(TrainerTest, a_checkpoint_that_is_none_is_damaged) {
  TrainOptions begun = options(test::kPanache, 5);
  begun.checkpoint = folder_ + "model.safetensors";
  const std::string file = begun.checkpoint + ".pose.checkpoint";
  for (const bool tensors : {false, true}) {
    ASSERT_TRUE(write_file(file, "no checkpoint", true).ok());
    if (tensors) torch::save(std::vector<torch::Tensor>(6, torch::zeros({2})), file);
    const auto trained = train(rows_, styles_, begun);
    ASSERT_FALSE(trained.ok());
    EXPECT_EQ(trained.error().message, file + ": is damaged; delete it to train from the start");
  }
}

// What cannot be paired is tests/lab/train/coverage_test.cpp.
TEST_F(TrainerTest, a_take_that_cannot_be_read_is_named) {
  std::vector<ManifestRow> rows = rows_;
  rows[1].path = folder_ + "none.bvh";
  EXPECT_EQ(train(rows, styles_, options(test::kPanache, 1)).error().message,
            folder_ + "none.bvh: cannot be read: No such file or directory");
}

TEST_F(TrainerTest, takes_of_the_test_split_are_not_trained_on) {
  std::vector<ManifestRow> rows = rows_;
  rows.push_back(rows[1]);
  rows.back().path = folder_ + "none.bvh";  // Would be missed if it were read.
  rows.back().test = true;
  EXPECT_TRUE(train(rows, styles_, options(test::kPanache, 1)).ok());
}

TEST_F(TrainerTest, the_timing_network_answers_with_the_mean_of_the_rates) {
  // The same windows twice, paired with two tempos: the best answer to each is the logarithm of
  // the mean rate, not the mean of the logarithms.
  Result<TrainingData> prepared = prepare_training(rows_, PoseLayout::positions);
  ASSERT_TRUE(prepared.ok()) << prepared.error().message;
  TrainingData& data = *prepared;
  data.pairings.resize(1);
  data.pairings[0].rates.assign(data.pairings[0].rates.size(), 0.5f);
  data.pairings.push_back(data.pairings[0]);
  data.pairings[1].rates.assign(data.pairings[1].rates.size(), 2.0f);
  const Pairing pairing = data.pairings[0];
  const Take neutral = data.takes[pairing.neutral];
  TrainOptions slow = options(test::kPanache, 400);
  slow.settings.batch.disturbed = slow.settings.batch.mirrored = false;
  slow.settings.optimizer.dropout = 0;
  const auto trained = train(data, styles_, slow);
  ASSERT_TRUE(trained.ok()) << trained.error().message;
  const auto model = Model::parse(format_safetensors(trained->model), "model");
  ASSERT_TRUE(model.ok()) << model.error().message;
  StyleNetworks networks(*model);
  networks.set_strengths(std::vector<float>{1});
  const int numbers = pose_feature_count(PoseLayout::positions);
  std::vector<float> window(size_t(kWindowPoses) * numbers);
  double rate = 0;
  for (int i = 10; i < 30; ++i) {
    take_window(neutral, pairing.neutral_frames[i], numbers, window);
    networks.forward(window);
    rate += std::exp(networks.log_rate()) / 20;
  }
  // The mean of the rates is 1.25, that of their logarithms belongs to 1. Each batch has its own
  // shares of both: 128 pairs, a deviation of 0.07, averaged over the last steps.
  EXPECT_NEAR(rate, 1.25, 0.08);
}

TEST_F(TrainerTest, the_gate_is_open_on_the_middle_of_what_was_trained_on_and_shut_far_away) {
  const auto trained = train(rows_, styles_, options(test::kPanache, 200));
  ASSERT_TRUE(trained.ok()) << trained.error().message;
  const auto model = Model::parse(format_safetensors(trained->model), "model");
  ASSERT_TRUE(model.ok()) << model.error().message;
  EXPECT_TRUE((*model)->can_learn());
  StyleNetworks networks(*model);
  networks.set_strengths(std::vector<float>{1});
  const TrainingData data = *prepare_training(rows_, PoseLayout::positions);
  const Take& neutral = data.takes[data.pairings.front().neutral];
  std::vector<float> window(size_t(kWindowPoses) * pose_feature_count(PoseLayout::positions));
  double gates = 0;
  for (int f = 40; f < 100; ++f) {
    take_window(neutral, static_cast<float>(f), pose_feature_count(PoseLayout::positions), window);
    networks.forward(window);
    gates += networks.gate() / 60;
  }
  EXPECT_GT(gates, 0.8);
  Random random(1);
  for (float& w : window) w = 5 * random.normal();
  networks.forward(window);
  EXPECT_LT(networks.gate(), 0.5 * gates);
}

TEST_F(TrainerTest, only_our_own_recipe_gets_a_gate) {
  const auto ours = train(rows_, styles_, options(test::kPanache, 2));
  const auto theirs = train(rows_, styles_, options(test::kSmith2019, 2));
  EXPECT_TRUE(ours->model.tensors.contains("gate.limit"));
  EXPECT_FALSE(theirs->model.tensors.contains("gate.limit"));
}

TEST(Losses, the_table_and_the_plot_hold_every_point) {
  const std::vector<LossPoint> losses = {{"pose", 100, 0.5f, 0.6f}, {"pose", 200, 0.25f, 0.5f}};
  EXPECT_EQ(losses_csv(losses),
            "network,step,train,validation\npose,100,0.500000,0.600000\n"
            "pose,200,0.250000,0.500000\n");
  EXPECT_NE(losses_svg(losses).find("pose, validation"), std::string::npos);
}

}  // namespace
}  // namespace panache
