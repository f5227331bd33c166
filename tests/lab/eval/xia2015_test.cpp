#include "eval/systems/xia2015/xia2015.h"

#include <cmath>

#include <gtest/gtest.h>

#include "base/random.h"
#include "eval/make_swings.h"
#include "known_recipes.h"
#include "learn/samples.h"
#include "learn/take.h"
#include "takes/manifest.h"

namespace panache {
namespace {

using namespace xia2015;

const std::vector<StyleName> kStyles = {{"old", {"old"}, ""}, {"wild", {"wild"}, ""}};

// A neutral walk; the same walk bent and with a wider swing; and one with a swing the other way.
struct Pairs {
  std::vector<Take> takes = {test::swinging_take("neutral", 150, 0.3f),
                             test::swinging_take("old", 150, 0.7f, 1, 0.4f),
                             test::swinging_take("wild", 150, -0.4f)};
  std::vector<Pairing> pairings = pair_takes(takes, {1, 2}, {0});
  SystemData data() const { return {takes, pairings, kStyles}; }
};

class Xia : public testing::Test {
 protected:
  const Pairs pairs_;
  const std::unique_ptr<Xia2015> system_ = *Xia2015::create("xia2015", pairs_.data());
};

// Mean distance, cm, of what the answers to `neutral` make of it from `styled`, frame by frame from
// the second second on.
double error_cm(InstantAnswers& answers, const std::string& style, const Take& neutral,
                const Take& styled) {
  double sum = 0;
  int count = 0;
  for (int f = 0; f < neutral.frames(); ++f) {
    const float at = static_cast<float>(f);
    const StyleDelta change = *answers.change(style, neutral, at, neutral, at);
    if (f < 30) continue;
    sum += pose_error(styled, f, neutral, at, change).cm;
    ++count;
  }
  return sum / count;
}

TEST_F(Xia, with_one_pair_it_returns_the_styled_take) {
  const Take &neutral = pairs_.takes[0], &old = pairs_.takes[1];
  double untouched = 0;
  for (int f = 30; f < neutral.frames(); ++f) {
    untouched +=
        pose_error(old, f, neutral, static_cast<float>(f), {}).cm / (neutral.frames() - 30);
  }
  EXPECT_GT(untouched, 4);
  // The alignment goes by whole frames, and a frame is worth 8 cm of a wide swing of the hand.
  EXPECT_LT(error_cm(*system_->instants(1), "old", neutral, old), 0.15 * untouched);
  EXPECT_LT(error_cm(*system_->instants(1), "wild", neutral, pairs_.takes[2]), 0.15 * untouched);
}

TEST_F(Xia, linear_maps_come_nearer_than_the_mean_of_the_neighbours) {
  LocalSettings means;
  means.penalty = 1e6f;
  const auto system = *Xia2015::create("xia2015", pairs_.data(), means);
  const double mean = error_cm(*system->instants(1), "wild", pairs_.takes[0], pairs_.takes[2]);
  const double maps = error_cm(*system_->instants(1), "wild", pairs_.takes[0], pairs_.takes[2]);
  EXPECT_LT(maps, 0.9 * mean);
}

TEST_F(Xia, motion_that_does_not_move_is_answered_too) {
  std::vector<Take> takes = {test::swinging_take("neutral", 90, 0),
                             test::swinging_take("old", 90, 0)};
  for (Take& take : takes) {
    for (int f = 0; f < take.frames(); ++f) {
      take.body[f] = take.body[0], take.root[f] = take.root[0];
      take.rotations[f] = take.rotations[0];
    }
    write_numbers(PoseLayout::positions, take);
  }
  const std::vector<Pairing> pairings = pair_takes(takes, {1}, {0});
  const auto system = *Xia2015::create("xia2015", {takes, pairings, kStyles});
  const auto answers = system->instants(1);
  for (float at = 0; at < 60; ++at) {
    std::array<float, StyleDelta::kSize> change;
    pack(*answers->change("old", takes[0], at, takes[0], at), change);
    for (const float number : change) ASSERT_NEAR(number, 0, 1e-4) << at;
  }
}

TEST_F(Xia, half_of_a_style_is_half_its_change_and_none_is_none) {
  const Take& neutral = pairs_.takes[0];
  const auto whole = system_->instants(1), half = system_->instants(0.5),
             none = system_->instants(0);
  for (float at = 20; at < 60; ++at) {
    std::array<float, StyleDelta::kSize> one, two, zero;
    pack(*whole->change("old", neutral, at, neutral, at), one);
    pack(*half->change("old", neutral, at, neutral, at), two);
    pack(*none->change("old", neutral, at, neutral, at), zero);
    for (int n = 0; n < StyleDelta::kSize; ++n) {
      ASSERT_NEAR(two[n], one[n] / 2, 1e-6) << n;
      ASSERT_EQ(zero[n], 0) << n;
    }
  }
}

TEST_F(Xia, two_styles_at_once_are_mixed_in_their_parameters) {
  const auto mixed = system_->make_source(pairs_.takes[0], 0, {{0, 0.25f}, {1, 0.75f}});
  const auto old = system_->make_source(pairs_.takes[0], 0, {{0, 1.0f}});
  const auto wild = system_->make_source(pairs_.takes[0], 0, {{1, 1.0f}});
  std::vector<float> window(size_t(kWindowPoses) * pose_feature_count(PoseLayout::positions));
  for (float at = 10; at < 40; ++at) {
    take_window(pairs_.takes[0], at, pose_feature_count(PoseLayout::positions), window);
    std::array<float, StyleDelta::kSize> both, a, b;
    const SourceInput seen = {window, nullptr, {1 / 30.0, 1 / 30.0f, at == 10}};
    pack(mixed->ask(seen).delta, both);
    pack(old->ask(seen).delta, a);
    pack(wild->ask(seen).delta, b);
    for (int n = 0; n < StyleDelta::kSize; ++n) {
      ASSERT_NEAR(both[n], 0.25f * a[n] + 0.75f * b[n], 1e-5) << n;
    }
  }
}

TEST_F(Xia, it_looks_at_no_frame_to_come) {
  const TestInput whole = test::swinging_input(95, 0.3f);
  // On the rig of the whole: a rig is calibrated on all frames of its clip. Neither is a loop, of
  // which all frames are looked at.
  const Clip first_frames = test::swinging_clip(50, 0.3f);
  const TestInput cut = {first_frames, whole.rig,
                         make_take(first_frames, whole.rig, PoseLayout::positions)};
  const StyleRequest request{"old", {{"old", 1.0f}}, false};
  const Take long_take = system_->run(whole, request)->output.take;
  const Take short_take = system_->run(cut, request)->output.take;
  for (int f = 0; f < short_take.frames(); ++f) {
    for (int j = 0; j < kHumanJoints; ++j) {
      ASSERT_EQ(short_take.body[f][j], long_take.body[f][j]) << f << " " << j;
    }
  }
}

TEST_F(Xia, at_strength_0_a_clip_comes_out_as_it_went_in) {
  const TestInput input = test::swinging_input(60, 0.3f);
  const Take output = system_->run(input, {"old", {{"old", 0.0f}}})->output.take;
  ASSERT_EQ(output.frames(), input.take.frames());
  for (int f = 0; f < output.frames(); ++f) {
    ASSERT_EQ(output.body[f], input.take.body[f]) << f;
  }
}

TEST_F(Xia, the_tempo_is_that_of_the_neighbours) {
  Pairs pairs;
  pairs.takes[1] = test::swinging_take("old", 150, 0.3f);
  for (int f = 0; f < 150; ++f) {  // Played one and a half times as fast.
    const int from = std::min(f * 3 / 2, 149);
    pairs.takes[1].body[f] = pairs.takes[0].body[from];
    pairs.takes[1].rotations[f] = pairs.takes[0].rotations[from];
  }
  for (auto* part : {&pairs.takes[1].body}) part->resize(99);
  pairs.takes[1].root.resize(99);
  pairs.takes[1].rotations.resize(99);
  pairs.takes[1].contacts.resize(99);
  write_numbers(PoseLayout::positions, pairs.takes[1]);
  pairs.pairings = pair_takes(pairs.takes, {1, 2}, {0});
  const auto system = *Xia2015::create("xia2015", pairs.data());
  const auto source = system->make_source(pairs.takes[0], 0, {{0, 1.0f}});
  std::vector<float> window(size_t(kWindowPoses) * pose_feature_count(PoseLayout::positions));
  double sum = 0;
  for (float at = 30; at < 120; ++at) {
    take_window(pairs.takes[0], at, pose_feature_count(PoseLayout::positions), window);
    const SourceInput seen = {window, nullptr, {1 / 30.0, 1 / 30.0f, at == 30}};
    sum += std::exp(source->ask(seen).log_rate) / 90;
  }
  EXPECT_NEAR(sum, 1.5, 0.05);  // The path advances by one frame or by two.
}

TEST_F(Xia, the_tree_finds_what_a_look_at_every_example_does) {
  const SampleSet set(pairs_.takes, pairs_.pairings, {"old", "wild"}, test::kPanache, false);
  const Database database(set, WindowKey(set), 0);
  ASSERT_GT(database.examples().size(), 100u);
  Random random(7);
  std::vector<Database::Neighbour> found;
  for (int trial = 0; trial < 20; ++trial) {
    std::array<float, kKeySize> key;
    for (float& k : key) k = 4 * random.normal();
    std::vector<float> distances;
    for (const Database::Example& example : database.examples()) {
      float sum = 0;
      for (int i = 0; i < kKeySize; ++i) {
        sum += (key[i] - example.key[i]) * (key[i] - example.key[i]);
      }
      distances.push_back(sum);
    }
    std::sort(distances.begin(), distances.end());
    database.find(key, 10, found);
    ASSERT_EQ(found.size(), 10u);
    for (size_t i = 0; i < found.size(); ++i) {
      EXPECT_NEAR(found[i].distance, distances[i], 1e-4f * distances[i]) << i;
    }
  }
}

TEST_F(Xia, a_styled_frame_counts_once_however_many_windows_were_laid_over_it) {
  const SampleSet set(pairs_.takes, pairs_.pairings, {"old", "wild"}, test::kPanache, false);
  const Database database(set, WindowKey(set), 0);
  EXPECT_GT(set.samples().size(), 400u);
  EXPECT_LE(database.examples().size(), 150u);
  EXPECT_EQ(&database.before(database.examples()[5]), &database.examples()[4]);
  EXPECT_EQ(&database.before(database.examples()[0]), &database.examples()[0]);
}

TEST(XiaWithoutPairs, is_told_what_is_missing) {
  const std::vector<Take> takes = {test::swinging_take("neutral", 60, 0.3f)};
  const auto system = Xia2015::create("xia2015", {takes, {}, kStyles});
  ASSERT_FALSE(system.ok());
  EXPECT_EQ(system.error().message,
            "xia2015: there is no pair of a neutral and a styled take to learn from");
}

}  // namespace
}  // namespace panache
