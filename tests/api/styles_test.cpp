// Styles over the C interface: taken out and put in, with sides, persons and gestures.

#include <cmath>
#include <cstring>

#include <panache/panache.hpp>

#include "stick_api.h"

namespace {

// Styles taken out of a model, removed and added, as bytes.

using panache::test::created;
using panache::test::info_of;
using panache::test::model_bytes;
using panache::test::model_of;
using panache::test::rejection;
using panache::test::text_of;

class StylesApi : public panache::test::StickApi {};

auto extract(const std::string& model, const char* name) {
  return [&, name](panache_bytes** out) {
    return panache_styles_extract(model.data(), model.size(), name, out);
  };
}
auto remove(const std::string& model, const char* name) {
  return [&, name](panache_bytes** out) {
    return panache_styles_remove(model.data(), model.size(), name, out);
  };
}
auto add(const std::string& model, const std::string& style, int replace) {
  return [&, replace](panache_bytes** out) {
    return panache_styles_add(model.data(), model.size(), style.data(), style.size(), replace, out);
  };
}

TEST_F(StylesApi, styles_have_the_groups_of_the_model) {
  const int count = panache_model_style_count(model_.get());
  std::string groups;
  for (int i = 0; i < count; ++i) groups += "group " + std::to_string(i / 2) + "\\n";
  const auto model = model_of(panache::test::with_list(model_bytes(), "style_groups", groups));
  for (int i = 0; i < count; ++i) {
    EXPECT_EQ(info_of(model.get(), i).group, "group " + std::to_string(i / 2));
  }
}

TEST_F(StylesApi, what_the_model_says_of_a_style_is_told) {
  const int32_t old = style_of("elderly");
  panache_style_info info = info_of(model_.get(), old);
  EXPECT_STREQ(panache_model_style_name(model_.get(), old), "old");
  EXPECT_NE(std::strstr(info.words, "elderly"), nullptr);
  EXPECT_STRNE(info.description, "");
  EXPECT_STREQ(info.thumbnail, "");
  EXPECT_EQ(info.has_sides, 1);
  EXPECT_EQ(info.is_learnt + info.takes_off, 0);
  EXPECT_EQ(info_of(panache::test::shipped_remover().get(), 0).takes_off, 1);

  EXPECT_EQ(panache_model_get_style_info(model_.get(), -1, &info), PANACHE_BAD_ARGUMENT);
  info.struct_size = 0;
  EXPECT_EQ(panache_model_get_style_info(model_.get(), old, &info), PANACHE_BAD_ARGUMENT);
}

TEST_F(StylesApi, a_style_is_extracted_removed_and_added_again) {
  const std::string whole = model_bytes();
  const int count = panache_model_style_count(model_.get());
  const char* last = panache_model_style_name(model_.get(), count - 1);
  const std::string style = text_of(created<panache_bytes>(extract(whole, last)));
  const std::string without = text_of(created<panache_bytes>(remove(whole, last)));
  const auto model = model_of(without);
  EXPECT_EQ(panache_model_find_style(model.get(), last), -1);
  EXPECT_EQ(panache_model_style_count(model.get()), count - 1);

  EXPECT_EQ(text_of(created<panache_bytes>(add(without, style, 0))), whole);
  EXPECT_EQ(text_of(created<panache_bytes>(add(whole, style, 1))), whole);
  panache_bytes_destroy(nullptr);
}

TEST_F(StylesApi, what_is_wrong_is_said_and_no_bytes_are_made) {
  const std::string whole = model_bytes(), part = "x",
                    style = text_of(created<panache_bytes>(extract(whole, "old")));
  const auto message = [](panache_status status, const auto& create) {
    return rejection<panache_bytes>(status, create);
  };
  EXPECT_EQ(message(PANACHE_BAD_ARGUMENT, add(whole, style, 0)),
            "the model: has a style 'old' already; replace it or give one of the two another "
            "name");
  EXPECT_EQ(panache_last_error_kind(), PANACHE_ERROR_STYLE_EXISTS);
  message(PANACHE_BAD_STYLE, add(whole, whole, 1));
  message(PANACHE_BAD_STYLE, add(whole, style.substr(0, 100), 1));
  message(PANACHE_BAD_MODEL, add(style, style, 1));
  EXPECT_NE(message(PANACHE_BAD_ARGUMENT, remove(whole, "nobody")).find("nobody"),
            std::string::npos);
  message(PANACHE_BAD_ARGUMENT, extract(whole, "nobody"));
  message(PANACHE_BAD_MODEL, extract(part, "old"));
}

// Sides of styles over the C interface, on the shipped model with sides of our own.

class Sides : public panache::test::StickApi {
 protected:
  // 'old' was captured on its right leg; the model says nothing of the others.
  void SetUp() override {
    old_ = style_of("old");
    std::string sides;
    for (int i = 0; i < panache_model_style_count(model_.get()); ++i) {
      sides += i == old_ ? "right leg\\n" : "\\n";
    }
    bytes_ = panache::test::with_list(model_bytes(), "style_sides", sides);
    model_ = model_of(bytes_);
    StickApi::SetUp();
  }

  int32_t old_ = -1;
  std::string bytes_;
};

TEST_F(Sides, are_named_by_words) {
  EXPECT_STREQ(info_of(model_.get(), old_).side, "right leg");
  const int32_t other = old_ == 0 ? 1 : 0;
  EXPECT_STREQ(info_of(model_.get(), other).side, "");
  const auto side = [&](const char* word) {
    float found = 7;
    EXPECT_EQ(panache_model_find_side(model_.get(), old_, word, &found), PANACHE_OK);
    return found;
  };
  EXPECT_EQ(side("right"), 1);
  EXPECT_EQ(side("left"), -1);
  EXPECT_EQ(side("captured"), 1);
  EXPECT_EQ(side("mirrored"), -1);
  float found = 7;
  EXPECT_EQ(panache_model_find_side(model_.get(), other, "left", &found), PANACHE_BAD_ARGUMENT);
  EXPECT_NE(std::strstr(panache_last_error(), "captured, mirrored or a number"), nullptr);
  EXPECT_EQ(panache_model_find_side(model_.get(), -1, "left", &found), PANACHE_BAD_ARGUMENT);
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
}

TEST_F(Sides, of_a_clip_are_an_option_that_an_older_program_does_not_set) {
  const panache::test::Walk walk = clip(90);
  std::vector<float> sides(static_cast<size_t>(panache_model_style_count(model_.get())), 1.0f);
  panache_stylize_options options = PANACHE_STYLIZE_OPTIONS;
  options.style_timing = 0;
  const auto rotations = [&] {
    const auto styled = stylize(walk.clip, "old", {{0, 1}}, &options);
    const float* first = panache_styled_clip_rotations(styled.get());
    return std::vector<float>(first, first + 4 * STICK_JOINTS * 90);
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
  EXPECT_EQ(rejection<panache_styled_clip>(PANACHE_BAD_ARGUMENT,
                                           [&](auto** out) {
                                             return panache_stylize_clip(model_.get(), &walk.clip,
                                                                         nullptr, 0, &options, out);
                                           }),
            "side of 2.000000 for style 'old'; expected -1 to 1");
}

TEST_F(Sides, are_in_the_cpp_header_too) {
  const panache::Model model(bytes_.data(), bytes_.size());
  const panache::Skeleton skeleton(stick_figure, STICK_JOINTS);
  panache::Character one(model, skeleton);
  panache_character* other = character("old");
  EXPECT_STREQ(model.style_info(old_).side, "right leg");
  one.set_strength(old_, 1);
  one.set_side(old_, model.find_side(old_, "left"));
  panache_character_set_side(other, old_, -1);
  EXPECT_TRUE(same(walk(one.get(), 60), walk(other, 60)));
  EXPECT_THROW(model.find_side(old_, "up"), panache::Error);
}

// Persons over the C interface, on the shipped model.

class PersonApi : public panache::test::StickApi {};

TEST_F(PersonApi, have_named_axes_and_numbers) {
  const int32_t axes = panache_model_person_axis_count(model_.get());
  ASSERT_GT(axes, 0);
  for (int32_t a = 0; a < axes; ++a) {
    ASSERT_NE(panache_model_person_axis_name(model_.get(), a), nullptr);
    EXPECT_GT(std::strlen(panache_model_person_axis_name(model_.get(), a)), 0u);
  }
  EXPECT_EQ(panache_model_person_axis_name(model_.get(), axes), nullptr);
  EXPECT_EQ(panache_model_person_axis_name(model_.get(), -1), nullptr);
  std::vector<float> drawn(axes), read(axes, 7.0f);
  ASSERT_EQ(panache_model_draw_person(model_.get(), 12, drawn.data(), axes), PANACHE_OK);
  panache_character* one = character();
  ASSERT_EQ(panache_character_get_person_numbers(one, read.data(), axes), PANACHE_OK);
  EXPECT_EQ(read, std::vector<float>(axes));
  ASSERT_EQ(panache_character_set_person(one, 12, 1), PANACHE_OK);
  ASSERT_EQ(panache_character_get_person_numbers(one, read.data(), axes), PANACHE_OK);
  EXPECT_EQ(read, drawn);
}

TEST_F(PersonApi, change_a_character_by_seed_or_by_numbers) {
  const int32_t axes = panache_model_person_axis_count(model_.get());
  std::vector<float> numbers(axes);
  ASSERT_EQ(
      panache_model_draw_person(model_.get(), panache_person_seed("mara"), numbers.data(), axes),
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
}

TEST_F(PersonApi, reject_what_is_no_person) {
  const int32_t axes = panache_model_person_axis_count(model_.get());
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
}

// Gestures over the C interface, of a shipped style.

class Gestures : public panache::test::StickApi {
 protected:
  int32_t scared() const { return style_of("scared"); }
};

TEST_F(Gestures, are_listed_by_style_and_place) {
  const int32_t style = scared(), count = info_of(model_.get(), style).gesture_count;
  ASSERT_GT(count, 0);
  for (int32_t k = 0; k < count; ++k) {
    EXPECT_GT(std::strlen(panache_model_gesture_name(model_.get(), style, k)), 0u);
  }
  EXPECT_EQ(panache_model_gesture_name(model_.get(), style, count), nullptr);
  EXPECT_EQ(panache_model_gesture_name(model_.get(), style, -1), nullptr);
  EXPECT_EQ(info_of(model_.get(), style_of("robot")).gesture_count, 0);
  for (const int32_t none : {-1, panache_model_style_count(model_.get())}) {
    EXPECT_EQ(panache_model_gesture_name(model_.get(), none, 0), nullptr);
  }
}

TEST_F(Gestures, a_trigger_plays_one_and_says_where_there_is_none) {
  panache_character* plain = character("scared");
  panache_character* triggered = character("scared");
  EXPECT_EQ(panache_character_trigger(triggered, scared(), 1), 1);
  EXPECT_EQ(panache_character_trigger(plain, scared(), 99), 0);
  EXPECT_EQ(panache_character_trigger(plain, -1, 0), 0);
  EXPECT_EQ(panache_character_trigger(plain, style_of("robot"), 0), 0);
  EXPECT_FALSE(same(walk(triggered, 60), walk(plain, 60)));
}

TEST_F(Gestures, are_played_as_often_as_the_option_says_and_not_for_an_older_program) {
  std::string rates;
  for (int i = 0; i < panache_model_style_count(model_.get()); ++i) {
    rates += i == scared() ? "1\\n" : "\\n";
  }
  model_ = model_of(panache::test::with_list(model_bytes(), "style_gesture_rates", rates));
  const auto walk_with = [&](const panache_character_options* options) {
    return walk(character("scared", 1, options), 240);
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
}

}  // namespace
