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

TEST_F(Gestures, at_random_they_are_an_option_that_an_older_program_does_not_set) {
  const auto walk_with = [&](const panache_character_options& options) {
    panache_character* out = nullptr;
    EXPECT_EQ(panache_character_create(model_, skeleton_, &options, &out), PANACHE_OK)
        << panache_last_error();
    panache_character_set_strength(out, scared(), 1);
    const auto walked = walk(out, 240);
    panache_character_destroy(out);
    return walked;
  };
  panache_character_options options = PANACHE_CHARACTER_OPTIONS;
  const auto plain = walk_with(options);
  options.gesture_rate = 1;
  const auto some = walk_with(options);
  EXPECT_FALSE(same(some, plain));
  EXPECT_TRUE(same(some, walk_with(options)));
  options.gesture_seed = 7;
  EXPECT_FALSE(same(some, walk_with(options)));
  options.struct_size = offsetof(panache_character_options, gesture_rate);
  EXPECT_TRUE(same(plain, walk_with(options)));
  options.struct_size = sizeof options;
  options.gesture_rate = -1;
  panache_character* none = nullptr;
  EXPECT_EQ(panache_character_create(model_, skeleton_, &options, &none), PANACHE_BAD_ARGUMENT);
  EXPECT_EQ(std::string(panache_last_error()).substr(0, 16), "gesture rate of ");
}

}  // namespace
