#include "train/few_takes.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "known_recipes.h"
#include "make_styled_takes.h"
#include "style/pose_change.h"

namespace panache {
namespace {

using enum HumanJoint;

constexpr float kClose = 1e-3f;

// One neutral take of each action, and styled ones that are copies of it but for a change.
class FewTakesTest : public testing::Test {
 protected:
  static constexpr int kFrames = 40;

  // Frames of the same motion, whatever the action is called.
  void add_styled(const std::string& style, const std::string& action, const StyleDelta& change) {
    const int neutral = neutral_take(action);
    Take take = takes_[neutral];
    take.row.style = style;
    take.row.neutral = false;
    for (int f = 0; f < take.frames(); ++f) {
      take.body[f] = change_body(take.body[f], change);
      for (int j = 0; j < kHumanJoints; ++j) {
        take.rotations[f][j] = exp_rotation(change.rotations[j]) * take.rotations[f][j];
      }
    }
    Pairing pairing{static_cast<int>(takes_.size()), neutral, 0, {}, {}, 0};
    for (int f = 0; f < kFrames; ++f) pairing.neutral_frames.push_back(static_cast<float>(f));
    pairing.rates.assign(kFrames, 1);
    pairings_.push_back(pairing);
    takes_.push_back(std::move(take));
    if (std::find(styles_.begin(), styles_.end(), style) == styles_.end()) styles_.push_back(style);
  }

  int neutral_take(const std::string& action) {
    for (size_t t = 0; t < takes_.size(); ++t) {
      if (takes_[t].row.neutral && takes_[t].row.content == action) return static_cast<int>(t);
    }
    takes_.push_back(test::styled_take("neutral", "walk", 0, kFrames));
    takes_.back().row.content = action;
    return static_cast<int>(takes_.size()) - 1;
  }

  // What the pairs of a style and action show after the correction; the same in all of them.
  StyleDelta corrected(const std::string& style, const std::string& action) {
    SampleSet set(takes_, pairings_, styles_, test::kPanache, false);
    replaced_ = correct_few_takes(takes_, set);
    for (size_t i = 0; i < set.samples().size(); ++i) {
      const Sample& sample = set.samples()[i];
      if (styles_[sample.style] == style && set.content(sample) == action) {
        return unpack(set.target(i).first<StyleDelta::kSize>());
      }
    }
    ADD_FAILURE() << "no sample of " << style << " " << action;
    return {};
  }

  // `styles` styles that lean, each more than the one before, and lower the forearms in one action.
  void add_leaning_styles(int styles) {
    for (int s = 0; s < styles; ++s) {
      for (const char* action : {"walk", "run", "back"}) {
        StyleDelta change = lean(s);
        if (action == std::string("back")) {
          for (const HumanJoint arm : {left_lower_arm, right_lower_arm}) {
            change.rotations[index(arm)] = kLowered;
          }
          change.hips_height -= kLower;
        }
        add_styled("style" + std::to_string(s), action, change);
      }
    }
  }
  static StyleDelta lean(int style) {
    StyleDelta change;
    change.rotations[index(spine)] = {0.05f * static_cast<float>(style + 1), 0, 0};
    return change;
  }

  static constexpr Vec3 kLowered = {0.8f, 0, 0};
  static constexpr float kLower = 0.04f;

  std::vector<Take> takes_;
  std::vector<Pairing> pairings_;
  std::vector<std::string> styles_;
  int replaced_ = 0;
};

TEST_F(FewTakesTest, what_all_styles_change_alike_in_one_action_is_taken_off) {
  add_leaning_styles(5);
  for (const char* action : {"walk", "run", "back"}) {
    const StyleDelta change = corrected("style1", action);
    EXPECT_NEAR(change.rotations[index(spine)].x, 0.1f, kClose) << action;
    EXPECT_NEAR(length(change.rotations[index(left_lower_arm)]), 0, kClose) << action;
    EXPECT_NEAR(change.hips_height, 0, kClose) << action;
  }
  EXPECT_EQ(replaced_, 0);
}

TEST_F(FewTakesTest, what_few_styles_change_alike_stays) {
  add_leaning_styles(4);
  const StyleDelta change = corrected("style1", "back");
  EXPECT_NEAR(change.rotations[index(left_lower_arm)].x, kLowered.x, kClose);
  EXPECT_NEAR(change.hips_height, -kLower, kClose);
}

TEST_F(FewTakesTest, what_many_neutral_takes_show_stays) {
  add_leaning_styles(5);
  for (int take = 0; take < 2; ++take) {
    takes_.push_back(takes_[neutral_take("back")]);
    pairings_.push_back(pairings_.back());
    pairings_.back().neutral = static_cast<int>(takes_.size()) - 1;
  }
  const StyleDelta change = corrected("style1", "back");
  EXPECT_NEAR(change.rotations[index(left_lower_arm)].x, kLowered.x, kClose);
}

class ArmsTest : public FewTakesTest {
 protected:
  // A style that turns its arms a little, and in waves raises the left one above the head.
  ArmsTest() {
    StyleDelta change;
    change.rotations[index(left_upper_arm)] = kUsual;
    change.rotations[index(right_upper_arm)] = {kUsual.x, -kUsual.y, -kUsual.z};
    for (const char* action : {"walk", "run"}) add_styled("high", action, change);
    for (int j = 0; j < 3; ++j) {
      change.rotations[index(left_upper_arm) + j] = kRaised;
    }
    raised_ = change;
    add_styled("high", "wave", raised_);
  }

  static constexpr Vec3 kUsual = {0, 0.1f, 0.2f}, kRaised = {0, 0, 2};
  StyleDelta raised_;
};

TEST_F(ArmsTest, an_arm_that_is_elsewhere_in_the_only_take_gets_the_usual_one) {
  const StyleDelta change = corrected("high", "wave");
  EXPECT_GT(replaced_, 0);
  EXPECT_NEAR(length(change.rotations[index(left_upper_arm)] - kUsual), 0, kClose);
  EXPECT_NEAR(length(change.rotations[index(left_hand)]), 0, kClose);
  EXPECT_NEAR(change.rotations[index(right_upper_arm)].z, -kUsual.z, kClose);
  EXPECT_NEAR(length(corrected("high", "walk").rotations[index(left_upper_arm)] - kUsual), 0,
              kClose);
}

TEST_F(ArmsTest, an_arm_that_is_elsewhere_in_three_takes_is_the_style) {
  add_styled("high", "wave", raised_);
  add_styled("high", "wave", raised_);
  const StyleDelta change = corrected("high", "wave");
  EXPECT_EQ(replaced_, 0);
  EXPECT_NEAR(length(change.rotations[index(left_upper_arm)] - kRaised), 0, kClose);
}

}  // namespace
}  // namespace panache
