// Gestures over the C interface, of a shipped style.
#include "stick_api.h"

namespace {

class Gestures : public panache::test::StickApi {
 protected:
  int32_t scared() const { return panache_model_find_style(model_, "scared"); }
};

TEST_F(Gestures, are_listed_by_style_and_place) {
  const int32_t style = scared(), count = panache_model_gesture_count(model_, style);
  ASSERT_GT(count, 0);
  for (int32_t k = 0; k < count; ++k) {
    EXPECT_GT(std::strlen(panache_model_gesture_name(model_, style, k)), 0u);
  }
  EXPECT_EQ(panache_model_gesture_name(model_, style, count), nullptr);
  EXPECT_EQ(panache_model_gesture_name(model_, style, -1), nullptr);
  EXPECT_EQ(panache_model_gesture_count(model_, panache_model_find_style(model_, "robot")), 0);
  for (const int32_t none : {-1, panache_model_style_count(model_)}) {
    EXPECT_EQ(panache_model_gesture_count(model_, none), 0);
    EXPECT_EQ(panache_model_gesture_name(model_, none, 0), nullptr);
  }
}

TEST_F(Gestures, a_trigger_plays_one_and_says_where_there_is_none) {
  panache_character* plain = character("scared");
  panache_character* triggered = character("scared");
  EXPECT_EQ(panache_character_trigger(triggered, scared(), 1), 1);
  EXPECT_EQ(panache_character_trigger(plain, scared(), 99), 0);
  EXPECT_EQ(panache_character_trigger(plain, -1, 0), 0);
  EXPECT_EQ(panache_character_trigger(plain, panache_model_find_style(model_, "robot"), 0), 0);
  EXPECT_FALSE(same(walk(triggered, 60), walk(plain, 60)));
  panache_character_destroy(triggered);
  panache_character_destroy(plain);
}

TEST_F(Gestures, are_played_as_often_as_the_option_says_and_not_for_an_older_program) {
  std::string rates;
  for (int i = 0; i < panache_model_style_count(model_); ++i)
    rates += i == scared() ? "1\\n" : "\\n";
  const std::string bytes =
      panache::test::with_list(panache::test::model_bytes(), "style_gesture_rates", rates);
  panache_model* model = nullptr;
  ASSERT_EQ(panache_model_create(bytes.data(), bytes.size(), &model), PANACHE_OK)
      << panache_last_error();
  const auto walk_with = [&](const panache_character_options* options) {
    panache_character* out = nullptr;
    EXPECT_EQ(panache_character_create(model, skeleton_, options, &out), PANACHE_OK)
        << panache_last_error();
    panache_character_set_strength(out, scared(), 1);
    const auto walked = walk(out, 240);
    panache_character_destroy(out);
    return walked;
  };
  panache_character_options options = PANACHE_CHARACTER_OPTIONS;
  const auto some = walk_with(&options);
  EXPECT_TRUE(same(some, walk_with(nullptr)));
  EXPECT_TRUE(same(some, walk_with(&options)));
  options.gesture_seed = 7;
  EXPECT_FALSE(same(some, walk_with(&options)));
  options.gesture_seed = 0;
  options.gesture_rate = 0;
  const auto none = walk_with(&options);
  EXPECT_FALSE(same(some, none));
  options.gesture_rate = 1;
  options.struct_size = offsetof(panache_character_options, gesture_rate);
  EXPECT_TRUE(same(none, walk_with(&options)));
  options.struct_size = sizeof options;
  options.gesture_rate = -1;
  panache_character* rejected = nullptr;
  EXPECT_EQ(panache_character_create(model, skeleton_, &options, &rejected), PANACHE_BAD_ARGUMENT);
  EXPECT_EQ(std::string(panache_last_error()).substr(0, 16), "gesture rate of ");
  panache_model_destroy(model);
}

}  // namespace
