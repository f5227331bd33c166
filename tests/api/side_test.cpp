// Sides of styles over the C interface, on the shipped model with sides of our own.
#include <panache/panache.hpp>

#include "stick_api.h"

namespace {

class Sides : public panache::test::StickApi {
 protected:
  // 'old' was captured on its right leg; the model says nothing of the others.
  void SetUp() override {
    panache::test::StickApi::SetUp();
    old_ = panache_model_find_style(model_, "old");
    std::string sides;
    for (int i = 0; i < panache_model_style_count(model_); ++i) {
      sides += i == old_ ? "right leg\\n" : "\\n";
    }
    bytes_ = panache::test::with_list(panache::test::model_bytes(), "style_sides", sides);
    panache_model_destroy(model_);
    ASSERT_EQ(panache_model_create(bytes_.data(), bytes_.size(), &model_), PANACHE_OK)
        << panache_last_error();
  }

  int32_t old_ = -1;
  std::string bytes_;
};

TEST_F(Sides, are_named_by_words) {
  EXPECT_STREQ(panache_model_style_side(model_, old_), "right leg");
  const int32_t other = old_ == 0 ? 1 : 0;
  EXPECT_STREQ(panache_model_style_side(model_, other), "");
  EXPECT_EQ(panache_model_style_side(model_, -1), nullptr);
  const auto side = [&](const char* word) {
    float found = 7;
    EXPECT_EQ(panache_model_find_side(model_, old_, word, &found), PANACHE_OK);
    return found;
  };
  EXPECT_EQ(side("right"), 1);
  EXPECT_EQ(side("left"), -1);
  EXPECT_EQ(side("captured"), 1);
  EXPECT_EQ(side("mirrored"), -1);
  float found = 7;
  EXPECT_EQ(panache_model_find_side(model_, other, "left", &found), PANACHE_BAD_ARGUMENT);
  EXPECT_NE(std::strstr(panache_last_error(), "captured, mirrored or a number"), nullptr);
  EXPECT_EQ(panache_model_find_side(model_, -1, "left", &found), PANACHE_BAD_ARGUMENT);
  EXPECT_EQ(found, 7);
}

TEST_F(Sides, of_a_character_change_what_it_does) {
  panache_character* plain = character("old");
  panache_character* mirrored = character("old");
  panache_character* set_back = character("old");
  panache_character* off = character();
  panache_character_set_side(mirrored, old_, -1);
  panache_character_set_side(set_back, old_, -1);
  panache_character_set_side(set_back, old_, 1);
  panache_character_set_side(off, old_, -1);
  panache_character_set_side(plain, -1, -1);
  panache_character_set_side(plain, old_, NAN);
  const auto captured = walk(plain, 60);
  EXPECT_FALSE(same(walk(mirrored, 60), captured));
  EXPECT_TRUE(same(walk(set_back, 60), captured));
  panache_character* nothing = character();
  EXPECT_TRUE(same(walk(off, 60), walk(nothing, 60)));
  for (panache_character* one : {plain, mirrored, set_back, off, nothing}) {
    panache_character_destroy(one);
  }
}

TEST_F(Sides, of_a_clip_are_an_option_that_an_older_program_does_not_set) {
  const panache::test::Walk walk(skeleton_, 90, false);
  const panache_strength_key key = {0, 1};
  const panache_strength_track track = {old_, 1, &key};
  std::vector<float> sides(static_cast<size_t>(panache_model_style_count(model_)), 1.0f);
  panache_stylize_options options = PANACHE_STYLIZE_OPTIONS;
  options.style_timing = 0;
  const auto rotations = [&] {
    panache_styled_clip* styled = nullptr;
    EXPECT_EQ(panache_stylize_clip(model_, &walk.clip, &track, 1, &options, &styled), PANACHE_OK)
        << panache_last_error();
    const float* first = panache_styled_clip_rotations(styled);
    std::vector<float> out(first, first + 4 * STICK_JOINTS * 90);
    panache_styled_clip_destroy(styled);
    return out;
  };
  const auto captured = rotations();
  options.sides = sides.data();
  EXPECT_EQ(rotations(), captured);
  sides[static_cast<size_t>(old_)] = -1;
  EXPECT_NE(rotations(), captured);
  options.struct_size = offsetof(panache_stylize_options, sides);
  EXPECT_EQ(rotations(), captured);
  options.struct_size = sizeof options;
  sides[static_cast<size_t>(old_)] = 2;
  panache_styled_clip* none = nullptr;
  EXPECT_EQ(panache_stylize_clip(model_, &walk.clip, &track, 1, &options, &none),
            PANACHE_BAD_ARGUMENT);
  EXPECT_STREQ(panache_last_error(), "side of 2.000000 for style 'old'; expected -1 to 1");
}

TEST_F(Sides, are_in_the_cpp_header_too) {
  const panache::Model model(bytes_.data(), bytes_.size());
  const panache::Skeleton skeleton(stick_figure, STICK_JOINTS);
  panache::Character one(model, skeleton);
  panache_character* other = character("old");
  EXPECT_STREQ(model.style_side(old_), "right leg");
  one.set_strength(old_, 1);
  one.set_side(old_, model.find_side(old_, "left"));
  panache_character_set_side(other, old_, -1);
  EXPECT_TRUE(same(walk(one.get(), 60), walk(other, 60)));
  EXPECT_THROW(model.find_side(old_, "up"), panache::Error);
  panache_character_destroy(other);
}

}  // namespace
