#include "eval/disturbances.h"

#include <numbers>

#include <gtest/gtest.h>

#include "eval/make_aligned.h"
#include "learn/samples.h"

namespace panache {
namespace {

SeenTakes see(const std::string& name, const std::vector<Take>& takes,
              PoseLayout layout = PoseLayout::positions) {
  for (const Disturbing& input : disturbing_inputs()) {
    if (input.name == name) return input.see(takes, layout);
  }
  ADD_FAILURE() << "no disturbance " << name;
  return {};
}

// The window of six poses that ends a second into the first take.
std::vector<float> window_of(const std::vector<Take>& takes, float frame = 30) {
  std::vector<float> window(size_t(kWindowPoses) * 66);
  take_window(takes[0], frame, 66, window);
  return window;
}

class Disturbances : public testing::Test {
 protected:
  const std::vector<Take> takes_ = {test::walk_take("neutral", "walk", 90, 0)};
  const std::vector<float> clean_ = window_of(takes_);
};

TEST_F(Disturbances, none_is_the_take_itself_in_the_layout_asked_for) {
  EXPECT_EQ(see("none", takes_).takes[0].pose_features, takes_[0].pose_features);
  const SeenTakes rotations = see("none", takes_, PoseLayout::rotations);
  EXPECT_EQ(rotations.takes[0].pose_features.size(), 130u * 90);
}

TEST_F(Disturbances, scale_is_on_positions_and_speeds_but_not_on_the_turn) {
  const std::vector<float> seen = window_of(see("body scale x 1.25", takes_).takes);
  for (int n = 0; n < 65; ++n) EXPECT_NEAR(seen[n], 1.25f * clean_[n], 1e-4) << n;
  EXPECT_NEAR(seen[65], clean_[65], 1e-4);
}

TEST_F(Disturbances, the_floor_moves_heights_only) {
  const std::vector<float> seen = window_of(see("floor -5 cm", takes_).takes);
  for (int n = 0; n < 66; ++n) {
    EXPECT_NEAR(seen[n], clean_[n] - (n < 63 && n % 3 == 1 ? 0.05f : 0), 1e-5) << n;
  }
}

TEST_F(Disturbances, a_wrong_facing_turns_body_and_way_alike) {
  const std::vector<float> seen = window_of(see("facing reversed", takes_).takes);
  for (int n = 0; n < 63; ++n) EXPECT_NEAR(seen[n], (n % 3 == 1 ? 1 : -1) * clean_[n], 1e-4) << n;
  EXPECT_NEAR(seen[63], -clean_[63], 1e-3);
  EXPECT_NEAR(seen[64], -clean_[64], 1e-3);
  EXPECT_NEAR(seen[65], clean_[65], 1e-3);
  EXPECT_GT(clean_[64], 1);  // It walks.

  // Thought to face 20 degrees further to its left, it walks to its right.
  const std::vector<float> turned = window_of(see("facing wrong by 20 degrees", takes_).takes);
  const float angle = -20 * std::numbers::pi_v<float> / 180;
  EXPECT_NEAR(std::atan2(turned[63], turned[64]), angle, 1e-3);
  for (int n = 0; n < 63; n += 3) {
    const Vec3 joint = {clean_[n], clean_[n + 1], clean_[n + 2]};
    const Vec3 expected = rotate(axis_angle(Vec3{0, 1, 0}, angle), joint);
    EXPECT_NEAR(length(Vec3{turned[n], turned[n + 1], turned[n + 2]} - expected), 0, 1e-5) << n;
  }
}

TEST_F(Disturbances, noise_is_a_centimetre_and_the_same_every_time) {
  const SeenTakes seen = see("1 cm noise on every joint", takes_);
  double squares = 0, count = 0;
  for (int f = 0; f < 90; ++f) {
    for (int j = 0; j < kHumanJoints; ++j) {
      const Vec3 off = seen.takes[0].body[f][j] - takes_[0].body[f][j];
      squares += dot(off, off) / 3;
      ++count;
    }
  }
  // 5,670 numbers: the estimate of their deviation is good to 1 %; three times that.
  EXPECT_NEAR(std::sqrt(squares / count), 0.01, 0.0003);
  EXPECT_EQ(see("1 cm noise on every joint", takes_).takes[0].pose_features,
            seen.takes[0].pose_features);
}

TEST_F(Disturbances, in_place_nothing_travels_and_the_body_is_the_same) {
  const std::vector<float> seen = window_of(see("in place", takes_).takes);
  for (int n = 0; n < 63; ++n) EXPECT_EQ(seen[n], clean_[n]);
  EXPECT_EQ(seen[63], 0);
  EXPECT_EQ(seen[64], 0);
}

TEST_F(Disturbances, at_twice_the_rate_poses_are_twice_as_far_apart_and_speeds_double) {
  const SeenTakes seen = see("rate wrong by 2", takes_);
  EXPECT_EQ(seen.speed, 2);
  EXPECT_EQ(seen.takes[0].frames(), 45);
  const std::vector<float> fast = window_of(seen.takes, 30 / seen.speed);
  for (int pose = 0; pose < kWindowPoses; ++pose) {
    const std::vector<float> then = window_of(takes_, 30 - 3.0f * static_cast<float>(pose));
    // Between frames of the faster take, straight lines are longer.
    for (int n = 0; n < 63; ++n) EXPECT_NEAR(fast[66 * pose + n], then[n], 0.02) << n;
  }
  EXPECT_NEAR(fast[64], 2 * clean_[64], 0.01);
}

TEST_F(Disturbances, another_posture_is_a_constant_that_leaves_the_way_alone) {
  const SeenTakes seen = see("another data set's mean posture", takes_);
  const Take& take = seen.takes[0];
  for (const HumanJoint joint : {HumanJoint::hips, HumanJoint::left_hand}) {
    const Vec3 first = take.body[0][index(joint)] - takes_[0].body[0][index(joint)];
    const Vec3 last = take.body[89][index(joint)] - takes_[0].body[89][index(joint)];
    EXPECT_GT(length(first), 0.01f);
    EXPECT_NEAR(length(first - last), 0, 1e-6);
  }
  const std::vector<float> window = window_of(seen.takes);
  for (int n = 63; n < 66; ++n) EXPECT_EQ(window[n], clean_[n]);
}

TEST(DisturbanceRows, a_model_that_looks_at_nothing_does_not_suffer) {
  const AlignedTakes test = test::bent_walks();
  const auto rows = measure_disturbances(test, test::as_system(test::bending_model(test::kBend)));
  ASSERT_EQ(rows.size(), 11u);
  EXPECT_EQ(rows[0].name, "none");
  const double clean =
      test.errors(test::as_system(test::bending_model(test::kBend))).at({"old", "walk"}).cm;
  for (const DisturbanceRow& row : rows) EXPECT_EQ(row.cm, clean) << row.name;
}

TEST(DisturbanceRows, a_model_that_looks_answers_differently_to_each) {
  const AlignedTakes test = test::bent_walks();
  for (const Recipe* recipe : {&test::kPanache, &test::kSmith2019}) {
    const auto model =
        *Model::parse(format_safetensors(test::make_model({"old", "sad"}, 1, *recipe)), "m");
    const auto rows = measure_disturbances(test, test::as_system(model));
    ASSERT_EQ(rows.size(), 11u);
    const PoseErrors errors = test.errors(test::as_system(model));
    EXPECT_DOUBLE_EQ(rows[0].cm,
                     (errors.at({"old", "walk"}).cm + errors.at({"sad", "walk"}).cm) / 2);
    // Rotations do not know of body scale, or hardly: the height of the hips is one of 130 numbers.
    for (size_t i = 1; i < rows.size(); ++i) EXPECT_NE(rows[i].cm, rows[0].cm) << rows[i].name;
  }
}

TEST(DisturbanceRows, a_model_without_the_styles_of_the_test_has_no_rows) {
  const auto model = *Model::parse(format_safetensors(test::make_model({"proud"})), "m");
  EXPECT_TRUE(measure_disturbances(test::bent_walks(), test::as_system(model)).empty());
}

}  // namespace
}  // namespace panache
