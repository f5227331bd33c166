// Sides of styles: a mirrored style is the mirror image of what the style makes of the mirrored
// input.

#include "style/model/model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include <gtest/gtest.h>

#include "make_clip.h"
#include "make_model.h"
#include "style/networks/networks.h"
#include "style/restyle.h"
#include "style_checks.h"

namespace panache {
namespace {

using test::same_bits;

// Two trained styles and a learnt one, each with a gate that is half closed for most windows.
TensorFile sided_file() {
  TensorFile file = test::make_model({"limping", "leaning"}, 3);
  test::add_gate(file, 1.5f);
  test::add_learnt(file, 0, "dragging", "a take");
  file.metadata["style_sides"] = "right leg\nto the left\n\n";
  return file;
}
std::shared_ptr<const Model> sided_model() { return *Model::create(sided_file(), "model"); }

std::vector<float> mirrored(std::vector<float> window) {
  mirror_poses(PoseLayout::positions, window);
  return window;
}

struct Answer {
  std::vector<float> pose;
  float log_rate, gate;
  std::array<float, 2> contact;
  Stance stance;
};
Answer mirrored(Answer answer) {
  test::kPanache.mirror_target(answer.pose);
  std::swap(answer.contact[0], answer.contact[1]);
  answer.stance.turn = {-answer.stance.turn[1], -answer.stance.turn[0]};
  return answer;
}
void expect_equal(const Answer& a, const Answer& b) {
  EXPECT_EQ(a.pose, b.pose);
  EXPECT_EQ(a.log_rate, b.log_rate);
  EXPECT_EQ(a.gate, b.gate);
  EXPECT_EQ(a.contact, b.contact);
  EXPECT_EQ(a.stance.heel, b.stance.heel);
  EXPECT_EQ(a.stance.turn, b.stance.turn);
}

// Evaluates a window, and tells how many passes that took.
Answer evaluate(StyleNetworks& networks, const std::vector<float>& window,
                const std::vector<float>& strengths, const std::vector<float>& sides,
                size_t* passes_taken = nullptr) {
  networks.set_strengths(strengths, sides);
  std::array<StyleNetworks::Pass, StyleNetworks::kMaxPasses> passes;
  const size_t count = networks.passes(window, 0.3f, passes);
  StyleNetworks::forward_all(std::span(passes).first(count));
  if (passes_taken) *passes_taken = count;
  return {{networks.pose().begin(), networks.pose().end()},
          networks.log_rate(),
          networks.gate(),
          networks.contact(),
          networks.stance()};
}

const std::vector<float> kStrengths = {1, -0.5f, 0.8f};

// To the bit: mirroring negates and swaps numbers, and a sum of two does not depend on their order.
TEST(Side, of_the_other_sign_on_the_mirrored_input_gives_the_mirrored_output) {
  const auto model = sided_model();
  for (const std::vector<float>& sides :
       {std::vector<float>{1, 1, 1}, {-1, -1, -1}, {0.4f, -1, 0}, {0, 0, 0}, {1, -0.2f, 0.7f}}) {
    std::vector<float> other = sides;
    for (float& side : other) side = -side;
    StyleNetworks plain(model), turned(model);
    for (uint64_t seed = 0; seed < 4; ++seed) {  // The gates move from window to window.
      const std::vector<float> window = window_of(2, seed);
      const Answer a = evaluate(plain, window, kStrengths, sides);
      expect_equal(evaluate(turned, mirrored(window), kStrengths, other), mirrored(a));
      EXPECT_GT(*std::ranges::max_element(a.pose), 0.01f);
    }
  }
}

TEST(Side, between_the_ends_is_the_weighted_mean_of_both) {
  const auto model = sided_model();
  const std::vector<float> window = window_of(2, 1);
  const auto pose_at = [&](float side) {
    StyleNetworks networks(model);
    return evaluate(networks, window, kStrengths, {side, side, side}).pose;
  };
  const auto captured = pose_at(1), mirrored = pose_at(-1), between = pose_at(0.5f);
  EXPECT_NE(captured, mirrored);
  for (size_t i = 0; i < between.size(); ++i) {
    EXPECT_NEAR(between[i], 0.75f * captured[i] + 0.25f * mirrored[i], 1e-5f);
  }
}

TEST(Side, of_each_style_is_its_own) {
  const auto model = sided_model();
  const std::vector<float> window = window_of(2, 1);
  const auto pose = [&](std::vector<float> strengths, std::vector<float> sides) {
    StyleNetworks networks(model);
    return evaluate(networks, window, strengths, sides).pose;
  };
  // The trained styles share a gate, which at first is that of the window.
  const auto both = pose({1, 1, 0}, {1, -1, 1});
  const auto one = pose({1, 0, 0}, {1, 1, 1}), other = pose({0, 1, 0}, {1, -1, 1});
  for (size_t i = 0; i < both.size(); ++i) EXPECT_NEAR(both[i], one[i] + other[i], 1e-5f);
}

TEST(Side, costs_a_second_pass_only_between_the_ends) {
  StyleNetworks networks(sided_model());
  const std::vector<float> window = window_of(2, 1);
  const auto passes = [&](std::vector<float> strengths, std::vector<float> sides) {
    size_t count = 0;
    evaluate(networks, window, strengths, sides, &count);
    return count;
  };
  EXPECT_EQ(passes({1, 0, 0.5f}, {1, -1, 1}), 1u);
  EXPECT_EQ(passes({1, 0, 0.5f}, {-1, 1, -1}), 1u);
  EXPECT_EQ(passes({1, 0, 0.5f}, {1, 1, -1}), 2u);
  EXPECT_EQ(passes({1, 0, 0.5f}, {0.9f, 1, 1}), 2u);
  EXPECT_EQ(passes({0, 0, 0}, {-1, 0, 0}), 1u) << "contacts are known without a style";
}

// ---- A whole character -----------------------------------------------------------------------

// The clip on the canonical skeleton, left for right.
Clip mirrored(const Clip& clip) {
  Clip out = clip;
  for (int f = 0; f < clip.frames; ++f) {
    for (int j = 0; j < kHumanJoints; ++j) {
      const auto from = static_cast<size_t>(kHumanMirror[static_cast<size_t>(j)]);
      const Quat q = clip.pose(f).rotations[from];
      const Vec3 t = clip.pose(f).translations[from];
      out.pose(f).rotations[static_cast<size_t>(j)] = {q.x, -q.y, -q.z, q.w};
      out.pose(f).translations[static_cast<size_t>(j)] = {-t.x, t.y, t.z};
    }
  }
  return out;
}

class SidedCharacter : public testing::Test {
 protected:
  SidedCharacter() : clip_(test::walking_clip(120, 30)), model_(sided_model()) {
    // Something that the mirrored walk has not.
    for (int f = 0; f < clip_.frames; ++f) {
      Quat& neck = clip_.pose(f).rotations[index(HumanJoint::neck)];
      neck = axis_angle({0, 1, 0}, 0.3f * std::sin(0.1f * static_cast<float>(f)));
    }
  }
  Stylizer character(const StylizerOptions& options = {}) const {
    return *Stylizer::create(model_, *Rig::create(clip_), options);
  }

  Clip clip_;
  std::shared_ptr<const Model> model_;
};

float largest_difference(const Clip& a, const Clip& b) {
  float largest = 0;
  for (size_t i = 0; i < a.rotations.size(); ++i) {
    const Quat apart = conjugate(a.rotations[i]) * b.rotations[i];
    largest = std::max(largest, length(Vec3{apart.x, apart.y, apart.z}));
    largest = std::max(largest, length(a.translations[i] - b.translations[i]));
  }
  return largest;
}

// A step computes in floats of about 1, so each of its some thousand operations rounds by 6e-8, and
// filters with a memory of up to a hundred steps add up: 1e-3 is beyond both.
TEST_F(SidedCharacter, mirrored_on_the_mirrored_input_moves_as_the_mirror_image) {
  for (const float side : {-1.0f, 0.0f, 0.3f}) {
    StylizerOptions options;
    options.sides = {side, side, side};
    Stylizer one = character(options);
    for (float& own : options.sides) own = -own;
    Stylizer other = *Stylizer::create(model_, *Rig::create(mirrored(clip_)), options);
    const Clip out = played(one, clip_, kStrengths);
    EXPECT_LT(largest_difference(mirrored(out), played(other, mirrored(clip_), kStrengths)), 1e-3f);
    EXPECT_GT(largest_difference(out, clip_), 0.05f);
  }
}

TEST_F(SidedCharacter, changes_sides_without_a_jump) {
  Stylizer still = character(), turning = character();
  Clip plain = clip_, turned = clip_;
  for (int f = 0; f < clip_.frames; ++f) {
    if (f == 60) turning.set_side(0, -1);
    still.step(clip_.pose(f), std::array{1.0f, 0.0f, 0.0f}, clip_.frame_time, plain.pose(f));
    turning.step(clip_.pose(f), std::array{1.0f, 0.0f, 0.0f}, clip_.frame_time, turned.pose(f));
  }
  const auto apart = [&](int f) {
    float largest = 0;
    for (size_t j = 0; j < clip_.joints(); ++j) {
      const Quat q = conjugate(plain.pose(f).rotations[j]) * turned.pose(f).rotations[j];
      largest = std::max(largest, length(Vec3{q.x, q.y, q.z}));
    }
    return largest;
  };
  EXPECT_LT(apart(59), 1e-6f);
  EXPECT_GT(apart(60), 1e-3f);
  EXPECT_LT(apart(60), 0.25f * apart(80)) << "eased over 0.15 s, and filtered";
}

TEST_F(SidedCharacter, ignores_sides_that_are_none) {
  Stylizer plain = character(), odd = character();
  odd.set_side(-1, -1), odd.set_side(3, -1), odd.set_side(0, std::nanf("")), odd.set_side(1, 7);
  EXPECT_TRUE(same_bits(played(plain, clip_, kStrengths), played(odd, clip_, kStrengths)));
}

TEST_F(SidedCharacter, plays_a_clip_on_its_side) {
  const Rig rig = *Rig::create(clip_);
  RestyleOptions options;
  const std::vector<StrengthTrack> tracks = {{0, {{0, 1}}}};
  const Restyled captured = *restyle(clip_, rig, model_, tracks, options);
  options.stylizer.sides = {-1, 1, 1};
  const Restyled turned = *restyle(mirrored(clip_), rig, model_, tracks, options);
  ASSERT_EQ(turned.clip.frames, captured.clip.frames);
  EXPECT_LT(largest_difference(mirrored(turned.clip), captured.clip), 1e-3f);
  options.stylizer.sides = {-1, 1};
  EXPECT_EQ(restyle(clip_, rig, model_, tracks, options).error().message,
            "2 sides; expected 3, one per style");
  options.stylizer.sides = {-1, 1.5f, 1};
  EXPECT_EQ(restyle(clip_, rig, model_, tracks, options).error().message,
            "side of 1.500000 for style 'leaning'; expected -1 to 1");
}

// ---- Words ------------------------------------------------------------------------------------

TEST(SideWords, name_the_captured_side_and_its_mirror_image) {
  const auto model = sided_model();
  EXPECT_EQ(model->styles()[0].side, "right leg");
  EXPECT_EQ(*find_side(*model, 0, "right"), 1);
  EXPECT_EQ(*find_side(*model, 0, "left"), -1);
  EXPECT_EQ(*find_side(*model, 1, "left"), 1);
  EXPECT_EQ(*find_side(*model, 1, "right"), -1);
  for (int style = 0; style < 3; ++style) {
    EXPECT_EQ(*find_side(*model, style, "captured"), 1);
    EXPECT_EQ(*find_side(*model, style, "mirrored"), -1);
  }
  EXPECT_EQ(find_side(*model, 2, "left").error().message,
            "the model does not say which side style 'dragging' was captured on, so 'left' is "
            "unknown; expected captured, mirrored or a number from -1 to 1");
  EXPECT_EQ(find_side(*model, 0, "up").error().message,
            "unknown side 'up' of style 'limping'; expected left, right, captured, mirrored or a "
            "number from -1 to 1");
  EXPECT_EQ(find_side(*model, 2, "").error().message,
            "unknown side '' of style 'dragging'; expected captured, mirrored or a number from -1 "
            "to 1");
}

TEST(SideWords, of_a_model_that_tells_none_are_rejected) {
  TensorFile file = sided_file();
  const auto message = [&](const std::string& sides) {
    file.metadata["style_sides"] = sides;
    const auto model = Model::create(file, "m.safetensors");
    return model.ok() ? "" : model.error().message;
  };
  EXPECT_EQ(message("right leg\n\nthe left arm\n"), "");
  EXPECT_EQ(
      message("\nboth legs\n\n"),
      "m.safetensors: metadata 'style_sides': style 'leaning': 'both legs'; expected a phrase "
      "with the word left or right in it once, such as 'left leg'");
  EXPECT_NE(message("left and right\n\n\n"), "");
  EXPECT_NE(message("leftwards\n\n\n"), "");
  EXPECT_EQ(message("right leg\n"),
            "m.safetensors: metadata 'style_sides' has 1 lines; expected 3, one per style");
}

TEST(SideWords, have_no_meaning_where_styles_share_their_networks) {
  const auto model =
      *Model::create(test::make_model({"old", "proud"}, 3, test::kSmith2019), "model");
  const std::string expected =
      "the styles of a model of recipe smith2019 have no sides, because they share their networks; "
      "expected a model in which each style has a head of its own";
  EXPECT_EQ(find_side(*model, 0, "mirrored").error().message, expected);
  const Clip clip = test::walking_clip(30);
  StylizerOptions options;
  options.sides = {1, 0};
  EXPECT_EQ(Stylizer::create(model, *Rig::create(clip), options).error().message, expected);
  Stylizer plain = *Stylizer::create(model, *Rig::create(clip), {}), sided = plain;
  sided.set_side(0, -1);
  EXPECT_TRUE(same_bits(played(plain, clip, {1, 0}), played(sided, clip, {1, 0})));
}

}  // namespace
}  // namespace panache
