#include "learn/samples.h"

#include <gtest/gtest.h>

#include "known_recipes.h"
#include "learn/disturbance.h"
#include "make_takes.h"
#include "pose/features.h"
#include "style/stages/pose_change.h"

namespace panache {
namespace {

class SamplesTest : public testing::TestWithParam<const Recipe*> {
 protected:
  SamplesTest()
      : layout_(GetParam()->layout),
        takes_{test::make_take("neutral", 200, 0, 1, 0, layout_),
               test::make_take("old", 90, 1.7f, 1.3f, 0.4f, layout_)},
        set_(takes_, pair_takes(takes_, {1}, {0}), {"old"}, *GetParam(), false) {}

  PoseLayout layout_;
  std::vector<Take> takes_;
  SampleSet set_;
};

TEST_P(SamplesTest, mirroring_twice_gives_the_same_numbers) {
  std::vector<float> window(set_.inputs());
  set_.window(7, window);
  std::vector<float> twice = window;
  mirror_poses(layout_, twice);
  EXPECT_NE(twice, window);
  mirror_poses(layout_, twice);
  EXPECT_EQ(twice, window);
  std::vector<float> target(set_.target(7).begin(), set_.target(7).end()), back = target;
  set_.recipe().mirror_target(back);
  EXPECT_NE(back, target);
  set_.recipe().mirror_target(back);
  EXPECT_EQ(back, target);
}

TEST_P(SamplesTest, the_mirrored_numbers_are_those_of_the_mirrored_body) {
  const HumanPositions body = body_at(takes_[0], 33);
  HumanPositions other;
  for (int j = 0; j < kHumanJoints; ++j) {
    other[kHumanMirror[j]] = {-body[j].x, body[j].y, body[j].z};
  }
  const int numbers = set_.numbers();
  std::vector<float> a(numbers), b(numbers);
  write_pose_features(layout_, body, std::span(a).first(numbers - kRootFeatures));
  write_pose_features(layout_, other, std::span(b).first(numbers - kRootFeatures));
  mirror_poses(layout_, a);
  for (int i = 0; i < numbers - kRootFeatures; ++i) EXPECT_NEAR(a[i], b[i], 1e-4) << i;
}

TEST_P(SamplesTest, every_sample_has_its_style_rate_and_contacts) {
  ASSERT_FALSE(set_.samples().empty());
  for (const Sample& sample : set_.samples()) {
    EXPECT_EQ(sample.style, 0);
    EXPECT_EQ(sample.take, 0);
    EXPECT_EQ(sample.contacts[0] + sample.contacts[1], 1);
    EXPECT_LT(std::abs(sample.log_rate), 0.7f);
  }
}

TEST_P(SamplesTest, neutral_frames_are_samples_without_a_style_where_asked_for) {
  const SampleSet both(takes_, pair_takes(takes_, {1}, {0}), {"old"}, *GetParam(), true);
  const size_t styled = set_.samples().size();
  ASSERT_EQ(both.samples().size(), styled + 200);
  std::vector<float> window(both.inputs()), expected(both.inputs());
  for (size_t i = styled; i < both.samples().size(); ++i) {
    const Sample& sample = both.samples()[i];
    EXPECT_EQ(sample.style, -1);
    EXPECT_EQ(sample.frame, static_cast<float>(i - styled));
    EXPECT_EQ(sample.contacts[0] + sample.contacts[1], 1);
    EXPECT_EQ(sample.log_rate, 0);
    EXPECT_EQ(sample.has_next, i + 1 < both.samples().size());
    both.window(i, window);
    take_window(takes_[0], sample.frame, both.numbers(), expected);
    ASSERT_EQ(window, expected);
    // They are to change nothing.
    const auto root = std::span(window).subspan(root_offset(layout_)).first<kRootFeatures>();
    std::array<float, StyleDelta::kSize> change;
    pack(GetParam()->to_change(both.target(i), body_at(takes_[0], sample.frame), root), change);
    for (const float number : change) ASSERT_NEAR(number, 0, 2e-3);
  }
}

INSTANTIATE_TEST_SUITE_P(, SamplesTest, testing::Values(&test::kPanache, &test::kSmith2019),
                         [](const auto& tested) { return tested.param->name; });

TEST(Samples, a_change_put_on_the_neutral_rotations_gives_the_styled_ones) {
  const Take neutral = test::make_take("neutral", 100, 0, 1, 0);
  const Take styled = test::make_take("old", 100, 0.3f, 1, 0.4f);
  const StyleDelta change = change_between(styled, 20, neutral, 31, 1);
  for (int j = 0; j < kHumanJoints; ++j) {
    const Quat reached = joint_rotation(change, j) * neutral.rotations[31][j];
    EXPECT_NEAR(std::abs(dot(reached, styled.rotations[20][j])), 1, 1e-5);
  }
}

TEST(Samples, an_absolute_pose_is_the_change_that_made_it) {
  const std::vector<Take> takes = {
      test::make_take("neutral", 200, 0, 1, 0, PoseLayout::rotations),
      test::make_take("old", 90, 1.7f, 1.3f, 0.4f, PoseLayout::rotations)};
  const std::vector<Pairing> pairings = pair_takes(takes, {1}, {0});
  const SampleSet absolute(takes, pairings, {"old"}, test::kSmith2019, false);
  const SampleSet changes(takes, pairings, {"old"}, test::kPanache, false);
  std::vector<float> window(absolute.inputs());
  for (const size_t i : {size_t{0}, size_t{20}, absolute.samples().size() - 1}) {
    absolute.window(i, window);
    const Sample& sample = absolute.samples()[i];
    const auto root =
        std::span(window).subspan(root_offset(PoseLayout::rotations)).first<kRootFeatures>();
    std::array<float, StyleDelta::kSize> back;
    pack(test::kSmith2019.to_change(absolute.target(i), body_at(takes[0], sample.frame), root),
         back);
    for (int n = 0; n < StyleDelta::kSize; ++n) {
      EXPECT_NEAR(back[n], changes.target(i)[n], 2e-3) << "number " << n;
    }
  }
}

TEST(Samples, an_undisturbing_disturbance_leaves_the_window_alone) {
  const std::vector<Take> takes = {test::make_take("neutral", 200, 0, 1, 0),
                                   test::make_take("old", 90, 1.7f, 1.3f, 0.4f)};
  const SampleSet set(takes, pair_takes(takes, {1}, {0}), {"old"}, test::kPanache, false);
  const Disturbance none;
  Random random(3);
  std::vector<float> window(set.inputs());
  set.window(5, window);
  std::vector<float> same = window;
  disturb(draw_disturbance(none, set.units(), random), none, random, same);
  EXPECT_EQ(same, window);
  const Disturbance& usual = kUsualDisturbance;
  disturb(draw_disturbance(usual, set.units(), random), usual, random, same);
  EXPECT_NE(same, window);
}

// Otherwise its feet would slide.
TEST(Samples, a_larger_body_goes_faster_by_as_much) {
  Disturbed draw;
  draw.scale = 1.25f;
  draw.posture.resize(63);
  std::vector<float> pose(66, 1.0f);
  Random random(5);
  disturb(draw, {}, random, pose);
  EXPECT_FLOAT_EQ(pose[0], 1.25f);
  EXPECT_FLOAT_EQ(pose[63 + kVelocityLeft], 1.25f);
  EXPECT_FLOAT_EQ(pose[63 + kVelocityForward], 1.25f);
}

TEST(Samples, another_person_has_the_same_limbs_held_otherwise) {
  const std::vector<Take> takes = {test::make_take("neutral", 200, 0, 1, 0),
                                   test::make_take("old", 90, 1.7f, 1.3f, 0.4f)};
  const SampleSet set(takes, pair_takes(takes, {1}, {0}), {"old"}, test::kPanache, false);
  Disturbance other;
  other.torso = other.head = other.legs = 0.1f;
  other.arms = 0.2f;
  Random random(4);
  std::vector<float> window(set.inputs());
  set.window(5, window);
  std::vector<float> turned = window, wider = window;
  disturb(draw_disturbance(other, set.units(), random), other, random, turned);
  for (int pose = 0; pose < kWindowPoses; ++pose) {
    const auto before = read_positions(std::span(window).subspan(size_t(pose) * 66, 66));
    const auto after = read_positions(std::span(turned).subspan(size_t(pose) * 66, 66));
    for (int j = 1; j < kHumanJoints; ++j) {
      const Vec3 limb = before[j] - before[kHumanParent[j]],
                 now = after[j] - after[kHumanParent[j]];
      EXPECT_NEAR(length(now), length(limb), 1e-5);
      EXPECT_GT(length(now - limb), 1e-3f * length(limb)) << j;
    }
  }
  other = {};
  other.amplitude = 0.3f;
  const Disturbed draw = draw_disturbance(other, set.units(), random);
  disturb(draw, other, random, wider);
  for (size_t i = 0; i < 63; ++i) {
    EXPECT_NEAR(wider[i] - set.mean()[i], draw.amplitude * (window[i] - set.mean()[i]), 1e-5);
  }
  EXPECT_NEAR(wider[63 + kVelocityForward], draw.amplitude * window[63 + kVelocityForward], 1e-5);
}

}  // namespace
}  // namespace panache
