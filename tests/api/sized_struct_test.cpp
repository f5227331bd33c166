// Structs that begin with their own size: what older and newer programs pass.
#include <array>
#include <cstddef>
#include <cstring>

#include "stick_api.h"

namespace {

using SizedStructs = panache::test::StickApi;
using panache::test::report_of;

template <class T>
constexpr bool ends_without_padding(size_t last_offset, size_t last_size) {
  return last_offset + last_size == sizeof(T);
}
// What is added to a struct must not lie in what was its padding: an older program never sets that.
#define ENDS_WITH(type, field) \
  static_assert(ends_without_padding<type>(offsetof(type, field), sizeof(type::field)))
ENDS_WITH(panache_skeleton_options, human_joints);
ENDS_WITH(panache_character_options, gesture_seed);
ENDS_WITH(panache_shape, energy);
ENDS_WITH(panache_report, ahead);
ENDS_WITH(panache_stylize_options, person);
ENDS_WITH(panache_retarget_options, meet_hands);
ENDS_WITH(panache_learnt_report, certainty);

TEST_F(SizedStructs, of_an_older_program_are_shorter_and_the_rest_is_as_by_default) {
  panache_character* shaped = character("old");
  panache_character* plain = character("old");
  // Such a program knows no field behind posture: whatever stands there is not the library's.
  panache_shape shape = PANACHE_SHAPE;
  shape.struct_size = offsetof(panache_shape, dynamics);
  shape.dynamics = shape.legs = 0;
  ASSERT_EQ(panache_character_set_shape(shaped, &shape), PANACHE_OK) << panache_last_error();
  EXPECT_TRUE(same(walk(shaped, 60), walk(plain, 60)));
  shape.posture = 0;
  ASSERT_EQ(panache_character_set_shape(shaped, &shape), PANACHE_OK);
  EXPECT_FALSE(same(walk(shaped, 60), walk(plain, 60)));

  panache_report report = PANACHE_REPORT;
  report.struct_size = offsetof(panache_report, rate);
  report.rate = -7;
  ASSERT_EQ(panache_character_get_report(shaped, &report), PANACHE_OK);
  EXPECT_EQ(report.gate, report_of(shaped).gate);
  EXPECT_GT(report.gate, 0);
  EXPECT_EQ(report.rate, -7);
  EXPECT_EQ(report.struct_size, offsetof(panache_report, rate));

  panache_character_options options = PANACHE_CHARACTER_OPTIONS;
  options.struct_size = offsetof(panache_character_options, skip_cycles);
  options.max_lag = -1;
  panache_character* late = nullptr;
  EXPECT_EQ(panache_character_create(model_, skeleton_, &options, &late), PANACHE_OK);
  for (panache_character* one : {shaped, plain, late}) panache_character_destroy(one);
}

TEST_F(SizedStructs, of_a_newer_program_are_longer_and_must_not_ask_for_what_is_not_there) {
  struct Newer {
    panache_shape shape = PANACHE_SHAPE;
    float added = 0;
  } newer;
  newer.shape.struct_size = sizeof newer;
  panache_character* old = character("old");
  EXPECT_EQ(panache_character_set_shape(old, &newer.shape), PANACHE_OK) << panache_last_error();
  newer.added = 1;
  EXPECT_EQ(panache_character_set_shape(old, &newer.shape), PANACHE_BAD_ARGUMENT);
  EXPECT_STREQ(panache_last_error(),
               "panache_shape: has fields that this library is too old for; leave them at 0");
  panache_character_destroy(old);
}

TEST_F(SizedStructs, without_a_possible_size_are_rejected_by_every_function_that_takes_one) {
  panache_character* old = character("old");
  const uint32_t kBad[] = {0, 3, 7, 5000, 0xffffffff};
  for (const uint32_t size : kBad) {
    const auto rejected = [&](panache_status status, const std::string& name) {
      EXPECT_EQ(status, PANACHE_BAD_ARGUMENT) << name;
      EXPECT_EQ(panache_last_error(), name + ": its struct_size is " + std::to_string(size) +
                                          ", expected sizeof(" + name + ")");
    };
    panache_shape shape = PANACHE_SHAPE;
    shape.struct_size = size;
    rejected(panache_character_set_shape(old, &shape), "panache_shape");
    panache_report report = PANACHE_REPORT;
    report.struct_size = size;
    rejected(panache_character_get_report(old, &report), "panache_report");
    panache_character_options character_options = PANACHE_CHARACTER_OPTIONS;
    character_options.struct_size = size;
    panache_character* none = old;
    rejected(panache_character_create(model_, skeleton_, &character_options, &none),
             "panache_character_options");
    EXPECT_EQ(none, nullptr);
    panache_skeleton_options skeleton_options = PANACHE_SKELETON_OPTIONS;
    skeleton_options.struct_size = size;
    panache_skeleton* no_skeleton = skeleton_;
    rejected(panache_skeleton_create(stick_figure, STICK_JOINTS, &skeleton_options, &no_skeleton),
             "panache_skeleton_options");
    EXPECT_EQ(no_skeleton, nullptr);
    panache_stylize_options stylize_options = PANACHE_STYLIZE_OPTIONS;
    stylize_options.struct_size = size;
    const panache::test::Walk walk(skeleton_, 30, false);
    panache_styled_clip* no_clip = nullptr;
    rejected(panache_stylize_clip(model_, &walk.clip, nullptr, 0, &stylize_options, &no_clip),
             "panache_stylize_options");
    stylize_options = PANACHE_STYLIZE_OPTIONS;
    stylize_options.shape = &shape;
    rejected(panache_stylize_clip(model_, &walk.clip, nullptr, 0, &stylize_options, &no_clip),
             "panache_shape");
  }
  panache_character_destroy(old);
}

}  // namespace
