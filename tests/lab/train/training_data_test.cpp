#include "train/training_data.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace panache {
namespace {

Take take_of(const std::string& path, const std::string& style, const std::string& content) {
  Take take;
  take.row.path = path;
  take.row.style = style;
  take.row.content = content;
  return take;
}

TEST(ValidationTakes, are_about_a_twentieth_whatever_their_folder) {
  std::vector<Take> here, there;
  for (int i = 0; i < 2000; ++i) {
    const std::string name = "take_" + std::to_string(i) + ".bvh";
    here.push_back(take_of("here/" + name, "old", "walk"));
    there.push_back(take_of("there/" + name, "old", "walk"));
  }
  const std::vector<bool> validates = validation_takes(here);
  const auto count = std::count(validates.begin(), validates.end(), true);
  EXPECT_GT(count, 60);
  EXPECT_LT(count, 140);
  EXPECT_EQ(validation_takes(there), validates);
}

TEST(ValidationTakes, leave_a_take_of_each_action_of_each_style_to_train_on) {
  // All takes that would be kept, were they among others.
  std::vector<Take> many;
  for (int i = 0; i < 2000; ++i) many.push_back(take_of(std::to_string(i), "old", "walk"));
  const std::vector<bool> kept = validation_takes(many);
  std::vector<std::string> names;
  for (size_t i = 0; i < many.size(); ++i) {
    if (kept[i]) names.push_back(many[i].row.path);
  }
  ASSERT_GE(names.size(), 6u);

  std::vector<Take> few = {take_of(names[0], "old", "walk"), take_of(names[1], "old", "run"),
                           take_of(names[2], "sad", "walk"), take_of(names[3], "angry", "walk"),
                           take_of(names[4], "angry", "walk")};
  EXPECT_EQ(validation_takes(few), (std::vector<bool>{false, false, false, false, true}));
  // A take of another set pairs with other neutral takes.
  few = {take_of(names[5], "sad", "run"), take_of("other", "sad", "run")};
  few[1].row.set = 1;
  EXPECT_EQ(validation_takes(few), (std::vector<bool>{false, false}));
  few[1].row.set = 0;
  EXPECT_TRUE(validation_takes(few)[0]);
}

}  // namespace
}  // namespace panache
