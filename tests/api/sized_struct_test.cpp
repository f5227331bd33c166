// Structs that begin with their own size: what older and newer programs pass.

#include <cstddef>
#include <cstring>

#include "stick_api.h"

namespace {

using SizedStructs = panache::test::StickApi;
using panache::test::created;
using panache::test::rejection;
using panache::test::report_of;

template <class T>
constexpr bool ends_without_padding(size_t last_offset, size_t last_size) {
  return last_offset + last_size == sizeof(T);
}
// What is added to a struct must not lie in what was its padding: an older program never sets that.
#define ENDS_WITH(type, field) \
  static_assert(ends_without_padding<type>(offsetof(type, field), sizeof(type::field)))
ENDS_WITH(panache_style_info, thumbnail);
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
  character(nullptr, 1, &options);
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
}

TEST_F(SizedStructs, without_a_possible_size_are_rejected_by_every_function_that_takes_one) {
  panache_character* old = character("old");
  const panache::test::Walk walk = clip(30);
  for (const uint32_t size : {0u, 3u, 7u, 5000u, 0xffffffffu}) {
    const auto expect_message = [&](const std::string& name, const std::string& message) {
      EXPECT_EQ(message, name + ": its struct_size is " + std::to_string(size) +
                             ", expected sizeof(" + name + ")");
    };
    panache_shape shape = PANACHE_SHAPE;
    shape.struct_size = size;
    EXPECT_EQ(panache_character_set_shape(old, &shape), PANACHE_BAD_ARGUMENT);
    expect_message("panache_shape", panache_last_error());
    panache_report report = PANACHE_REPORT;
    report.struct_size = size;
    EXPECT_EQ(panache_character_get_report(old, &report), PANACHE_BAD_ARGUMENT);
    expect_message("panache_report", panache_last_error());
    panache_character_options character_options = PANACHE_CHARACTER_OPTIONS;
    character_options.struct_size = size;
    expect_message("panache_character_options",
                   rejection<panache_character>(PANACHE_BAD_ARGUMENT, [&](auto** out) {
                     return panache_character_create(model_.get(), skeleton_.get(),
                                                     &character_options, out);
                   }));
    panache_skeleton_options skeleton_options = PANACHE_SKELETON_OPTIONS;
    skeleton_options.struct_size = size;
    expect_message("panache_skeleton_options",
                   rejection<panache_skeleton>(PANACHE_BAD_ARGUMENT, [&](auto** out) {
                     return panache_skeleton_create(stick_figure, STICK_JOINTS, &skeleton_options,
                                                    out);
                   }));
    panache_stylize_options stylize_options = PANACHE_STYLIZE_OPTIONS;
    const auto stylize = [&](auto** out) {
      return panache_stylize_clip(model_.get(), &walk.clip, nullptr, 0, &stylize_options, out);
    };
    stylize_options.shape = &shape;
    expect_message("panache_shape", rejection<panache_styled_clip>(PANACHE_BAD_ARGUMENT, stylize));
    stylize_options.struct_size = size;
    expect_message("panache_stylize_options",
                   rejection<panache_styled_clip>(PANACHE_BAD_ARGUMENT, stylize));
  }
}

// The joint map of panache_skeleton_options.

class JointMap : public panache::test::StickApi {
 protected:
  using Map = std::vector<panache_human_joint>;

  // The skeleton of the figure with a map; `count` is of the map.
  auto create(const Map& map, int32_t count) const {
    return [&, count](panache_skeleton** out) {
      panache_skeleton_options options = PANACHE_SKELETON_OPTIONS;
      options.human_joints = map.data();
      options.human_joint_count = count;
      return panache_skeleton_create(joints_.data(), STICK_JOINTS, &options, out);
    };
  }
  void expect_finds(const Map& map, const Map& expected) const {
    const auto mapped = created<panache_skeleton>(create(map, static_cast<int32_t>(map.size())));
    for (const panache_human_joint& joint : expected) {
      EXPECT_EQ(panache_skeleton_find(mapped.get(), joint.vrm_name), joint.joint) << joint.vrm_name;
    }
  }

  std::vector<panache_joint> joints_{stick_figure, stick_figure + STICK_JOINTS};
};

TEST_F(JointMap, says_which_joints_they_are_even_where_all_have_one_name) {
  for (panache_joint& joint : joints_) joint.name = "joint";
  expect_finds({{"head", 4}, {"leftToes", -1}, {"leftHand", 7}, {"rightHand", 10}},
               {{"head", 4}, {"leftHand", 7}, {"leftToes", -1}, {"leftUpperLeg", 11}});
}

TEST_F(JointMap, goes_before_the_names_of_the_joints) {
  EXPECT_EQ(panache_skeleton_find(skeleton_.get(), "neck"), 3);
  expect_finds({{"neck", -1}}, {{"neck", -1}});
}

TEST_F(JointMap, may_say_all_there_is) {
  Map whole;
  for (const char* name :
       {"hips",          "spine",         "chest",         "neck",          "head",
        "leftShoulder",  "leftUpperArm",  "leftLowerArm",  "leftHand",      "rightShoulder",
        "rightUpperArm", "rightLowerArm", "rightHand",     "leftUpperLeg",  "leftLowerLeg",
        "leftFoot",      "leftToes",      "rightUpperLeg", "rightLowerLeg", "rightFoot",
        "rightToes"}) {
    whole.push_back({name, panache_skeleton_find(skeleton_.get(), name)});
  }
  expect_finds(whole, whole);
}

TEST_F(JointMap, that_is_wrong_is_rejected_with_its_entry) {
  const auto message = [&](const Map& map, int32_t count) {
    return rejection<panache_skeleton>(PANACHE_BAD_ARGUMENT, create(map, count));
  };
  const struct {
    Map map;
    const char* message;
  } kRows[] = {
      {{{"head", 4}, {"tail", 3}},
       "human joint 1: there is no human joint 'tail' that a style turns"},
      {{{nullptr, 3}}, "human joint 0: there is no human joint '' that a style turns"},
      {{{"head", 19}}, "human joint 0 'head': joint is 19; expected -1 to 18"},
      {{{"head", -2}}, "human joint 0 'head': joint is -2; expected -1 to 18"},
      {{{"head", 4}, {"head", 3}}, "human joint 1 'head': is listed twice"},
      {Map(22, {"head", 4}), "22 human joints; expected an array of 0 to 21"},
  };
  for (const auto& row : kRows) {
    EXPECT_EQ(message(row.map, static_cast<int32_t>(row.map.size())), row.message);
  }
  for (const int32_t count : {-1, 1}) {
    EXPECT_EQ(message({}, count),
              std::to_string(count) + " human joints; expected an array of 0 to 21");
  }
}

}  // namespace
