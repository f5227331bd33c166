#include <cmath>

#include <gtest/gtest.h>

#include "known_recipes.h"
#include "learn/disturbance.h"
#include "learn/fit_style.h"
#include "learn/make_takes.h"
#include "learn/samples.h"
#include "learn/take.h"
#include "make_model.h"
#include "pose/features.h"
#include "style/networks/networks.h"
#include "style/stages/shaping.h"

namespace panache {
namespace {

// A neutral take and a styled one that is a little faster.
std::vector<Take> two_takes(PoseLayout layout = PoseLayout::positions) {
  return {test::make_take("neutral", 200, 0, 1, 0, layout),
          test::make_take("old", 90, 1.7f, 1.3f, 0.4f, layout)};
}
SampleSet samples_of(const std::vector<Take>& takes, const Recipe& recipe, bool neutral = false) {
  return SampleSet(takes, pair_takes(takes, {1}, {0}), {"old"}, recipe, neutral);
}

class SamplesTest : public testing::TestWithParam<const Recipe*> {
 protected:
  SamplesTest()
      : layout_(GetParam()->layout),
        takes_(two_takes(layout_)),
        set_(samples_of(takes_, *GetParam())) {}

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
  const SampleSet both = samples_of(takes_, *GetParam(), true);
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
  const std::vector<Take> takes = two_takes(PoseLayout::rotations);
  const SampleSet absolute = samples_of(takes, test::kSmith2019);
  const SampleSet changes = samples_of(takes, test::kPanache);
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
  const std::vector<Take> takes = two_takes();
  const SampleSet set = samples_of(takes, test::kPanache);
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
  const std::vector<Take> takes = two_takes();
  const SampleSet set = samples_of(takes, test::kPanache);
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

TEST(PoseError, the_true_change_leaves_no_error) {
  const Take neutral = test::walk_take("neutral", "walk", 60, 0);
  const Take styled = test::walk_take("old", "walk", 60, test::kBend);
  const StyleDelta truth = change_between(styled, 20, neutral, 20, 1);
  const PoseError error = pose_error(styled, 20, neutral, 20, truth);
  // Rotation vectors in single precision; the trunk is resampled along its bend.
  EXPECT_LT(error.degrees, 0.05);
  EXPECT_LT(error.cm, 0.5);
}

TEST(PoseError, a_turn_of_one_joint_is_shared_among_all_joints) {
  const Take neutral = test::walk_take("neutral", "walk", 60, 0);
  StyleDelta change;
  change.rotations[index(HumanJoint::head)].x = 0.5f;
  const PoseError error = pose_error(neutral, 20, neutral, 20, change);
  EXPECT_NEAR(error.degrees, 0.5 * 180 / M_PI / kHumanJoints, 1e-3);
  EXPECT_NEAR(error.cm, 0, 1e-6);  // Nothing hangs on the head.
}

TEST(PoseError, a_body_that_is_too_low_is_off_by_that_much_everywhere) {
  const Take neutral = test::walk_take("neutral", "walk", 60, 0);
  StyleDelta change;
  change.hips_height = -0.07f;
  const PoseError error = pose_error(neutral, 20, neutral, 20, change);
  EXPECT_NEAR(error.cm, 7, 1e-4);
  EXPECT_NEAR(error.degrees, 0, 1e-3);
}

TEST(PoseError, between_frames_the_neutral_body_is_between_them) {
  const Take neutral = test::walk_take("neutral", "walk", 60, 0);
  const double before = pose_error(neutral, 20, neutral, 20, {}).cm;
  const double half = pose_error(neutral, 20, neutral, 20.5f, {}).cm;
  const double whole = pose_error(neutral, 20, neutral, 21, {}).cm;
  EXPECT_EQ(before, 0);
  EXPECT_NEAR(half, whole / 2, 0.02 * whole);
}

TEST(ActivationStatistics, are_those_of_neutral_takes_that_are_not_held_out) {
  std::vector<Take> takes = {test::make_take("neutral", 40, 0, 1, 0)};
  TensorFile file = test::make_model({"old"});
  ASSERT_TRUE(add_activation_statistics(takes, file).ok());
  const auto model = *Model::parse(format_safetensors(file), "m");
  ASSERT_TRUE(model->can_learn());
  // By hand, of every fifth frame, as the file keeps it in 16 bits.
  const StyleNetworks networks(model);
  std::vector<float> window(size_t(kWindowPoses) * 66), activations(model->activation_count());
  double sum = 0, squares = 0;
  for (int f = 0; f < 40; f += 5) {
    take_window(takes[0], static_cast<float>(f), 66, window);
    networks.activations(window, activations);
    sum += activations[20] / 8.0;
    squares += double(activations[20]) * activations[20] / 8.0;
  }
  EXPECT_NEAR(model->activation_mean()[20], sum, 1e-3);
  EXPECT_NEAR(model->activation_scale()[20], std::sqrt(squares - sum * sum) + 0.01, 1e-3);

  takes.push_back(test::make_take("old", 40, 0, 1, 0.5f));
  takes.push_back(test::make_take("neutral", 40, 2, 1, 0.9f));
  takes.back().row.test = true;
  TensorFile again = test::make_model({"old"});
  ASSERT_TRUE(add_activation_statistics(takes, again).ok());
  EXPECT_EQ(again.tensors["learn.mean"].values, file.tensors["learn.mean"].values);
}

TEST(ActivationStatistics, a_model_of_the_slides_recipe_cannot_have_them) {
  TensorFile file = test::make_model({"old"}, 1, test::kSmith2019);
  const Result<void> added = add_activation_statistics({}, file);
  ASSERT_FALSE(added.ok());
  EXPECT_EQ(added.error().message,
            "the model is of recipe smith2019, on which no style can be learnt");
}

}  // namespace
}  // namespace panache
