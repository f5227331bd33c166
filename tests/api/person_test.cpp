// Persons over the C interface, on the shipped model.
#include <cmath>
#include <cstring>

#include "stick_api.h"

namespace {

class PersonApi : public panache::test::StickApi {};

TEST_F(PersonApi, have_named_axes_and_numbers) {
  const int32_t axes = panache_model_person_axis_count(model_);
  ASSERT_GT(axes, 0);
  for (int32_t a = 0; a < axes; ++a) {
    ASSERT_NE(panache_model_person_axis_name(model_, a), nullptr);
    EXPECT_GT(std::strlen(panache_model_person_axis_name(model_, a)), 0u);
  }
  EXPECT_EQ(panache_model_person_axis_name(model_, axes), nullptr);
  EXPECT_EQ(panache_model_person_axis_name(model_, -1), nullptr);
  std::vector<float> drawn(axes), read(axes, 7.0f);
  ASSERT_EQ(panache_model_draw_person(model_, 12, drawn.data(), axes), PANACHE_OK);
  panache_character* one = character();
  ASSERT_EQ(panache_character_get_person_numbers(one, read.data(), axes), PANACHE_OK);
  EXPECT_EQ(read, std::vector<float>(axes));
  ASSERT_EQ(panache_character_set_person(one, 12, 1), PANACHE_OK);
  ASSERT_EQ(panache_character_get_person_numbers(one, read.data(), axes), PANACHE_OK);
  EXPECT_EQ(read, drawn);
  panache_character_destroy(one);
}

TEST_F(PersonApi, change_a_character_by_seed_or_by_numbers) {
  const int32_t axes = panache_model_person_axis_count(model_);
  std::vector<float> numbers(axes);
  ASSERT_EQ(panache_model_draw_person(model_, panache_person_seed("mara"), numbers.data(), axes),
            PANACHE_OK);
  panache_character* nobody = character();
  panache_character* zero = character();
  panache_character* seeded = character();
  panache_character* numbered = character();
  panache_character* other = character();
  ASSERT_EQ(panache_character_set_person(zero, 3, 0), PANACHE_OK);
  ASSERT_EQ(panache_character_set_person(seeded, panache_person_seed("mara"), 1), PANACHE_OK);
  ASSERT_EQ(panache_character_set_person_numbers(numbered, numbers.data(), axes), PANACHE_OK);
  ASSERT_EQ(panache_character_set_person(other, 4, 1), PANACHE_OK);
  const auto plain = walk(nobody, 60), as_seed = walk(seeded, 60);
  EXPECT_TRUE(same(walk(zero, 60), plain));
  EXPECT_FALSE(same(as_seed, plain));
  EXPECT_TRUE(same(walk(numbered, 60), as_seed));
  EXPECT_FALSE(same(walk(other, 60), as_seed));
  for (panache_character* one : {nobody, zero, seeded, numbered, other}) {
    panache_character_destroy(one);
  }
}

TEST_F(PersonApi, reject_what_is_no_person) {
  const int32_t axes = panache_model_person_axis_count(model_);
  std::vector<float> numbers(axes);
  panache_character* one = character();
  EXPECT_EQ(panache_character_set_person(one, 1, 2.5f), PANACHE_BAD_ARGUMENT);
  EXPECT_NE(std::strstr(panache_last_error(), "expected 0 to 2"), nullptr);
  EXPECT_EQ(panache_character_set_person(one, 1, NAN), PANACHE_BAD_ARGUMENT);
  EXPECT_EQ(panache_character_set_person_numbers(one, numbers.data(), axes + 1),
            PANACHE_BAD_ARGUMENT);
  numbers[0] = INFINITY;
  EXPECT_EQ(panache_character_set_person_numbers(one, numbers.data(), axes), PANACHE_BAD_ARGUMENT);
  EXPECT_NE(std::strstr(panache_last_error(), "not finite"), nullptr);
  panache_character_destroy(one);
}

}  // namespace
