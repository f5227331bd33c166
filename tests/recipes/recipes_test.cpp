// What every recipe of the table promises, a toy among them.

#include "recipes/recipe.h"

#include <gtest/gtest.h>

#include "base/random.h"
#include "make_clip.h"
#include "pose/features.h"
#include "pose/observer.h"

namespace panache {
namespace {

class EveryRecipe : public testing::TestWithParam<const Recipe*> {
 protected:
  EveryRecipe() : recipe_(*GetParam()) {
    Clip clip = test::walking_clip(5);
    PosedRig rig(*Rig::create(clip));
    Observation seen;
    observe(rig, clip.pose(3), 0, seen);
    body_ = seen.body_frame;
    Random random(3);
    for (Vec3& r : change_.rotations) {
      r = {0.2f * random.normal(), 0.2f * random.normal(), 0.2f * random.normal()};
    }
    change_.hips_height = -0.07f;
    change_.velocity_left = 0.1f;
    change_.velocity_forward = -0.3f;
    change_.turn_rate = 0.2f;
  }
  std::vector<float> target(const StyleDelta& change) const {
    std::vector<float> numbers(static_cast<size_t>(recipe_.outputs));
    recipe_.write_target(change, body_, root_, numbers);
    return numbers;
  }

  const Recipe& recipe_;
  HumanPositions body_;
  const std::array<float, kRootFeatures> root_ = {0.1f, 1.2f, -0.3f};
  StyleDelta change_;
};

TEST_P(EveryRecipe, is_found_by_its_name) { EXPECT_EQ(find_recipe(recipe_.name), &recipe_); }

TEST_P(EveryRecipe, the_change_that_a_target_is_has_that_target) {
  const std::vector<float> once = target(change_);
  const std::vector<float> again = target(recipe_.to_change(once, body_, root_));
  // Rotation vectors through quaternions and back, in single precision.
  for (size_t n = 0; n < once.size(); ++n) EXPECT_NEAR(again[n], once[n], 1e-5) << "number " << n;
}

TEST_P(EveryRecipe, a_target_mirrored_twice_is_itself_and_once_another) {
  std::vector<float> numbers = target(change_);
  const std::vector<float> before = numbers;
  recipe_.mirror_target(numbers);
  EXPECT_NE(numbers, before);
  recipe_.mirror_target(numbers);
  EXPECT_EQ(numbers, before);
}

TEST_P(EveryRecipe, fills_the_numbers_that_it_asks_for_of_the_styles) {
  const std::vector<float> strengths = {0.25f, 0.5f};
  constexpr float kUntouched = 7;
  std::vector<float> numbers(static_cast<size_t>(recipe_.style_inputs(2)), kUntouched);
  recipe_.write_style_inputs(strengths, numbers);
  EXPECT_EQ(std::count(numbers.begin(), numbers.end(), kUntouched), 0);
  EXPECT_EQ(numbers.empty(), recipe_.style_heads);  // The style gets in by one way or the other.
}

TEST_P(EveryRecipe, has_a_scale_above_zero_for_each_output_where_it_has_one) {
  if (!recipe_.output_scale) return;
  const std::vector<float> scale = recipe_.output_scale();
  EXPECT_EQ(scale.size(), static_cast<size_t>(recipe_.outputs));
  for (const float s : scale) EXPECT_GT(s, 0);
}

INSTANTIATE_TEST_SUITE_P(, EveryRecipe, testing::ValuesIn(recipes().begin(), recipes().end()),
                         [](const auto& tested) { return std::string(tested.param->name); });

TEST(Recipes, the_first_of_the_table_is_the_default) {
  EXPECT_EQ(&default_recipe(), find_recipe("panache"));
}

TEST(Recipes, messages_list_them) {
  EXPECT_EQ(recipe_names(), "panache, toy or smith2019");
  EXPECT_EQ(learning_recipe_names(), "panache");
}

TEST(Recipes, there_is_none_of_another_name) {
  EXPECT_EQ(find_recipe("magic"), nullptr);
  EXPECT_EQ(find_recipe(""), nullptr);
}

}  // namespace
}  // namespace panache
