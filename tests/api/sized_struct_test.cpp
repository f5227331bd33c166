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
  panache_character* late = nullptr;
  EXPECT_EQ(panache_character_create(model_, skeleton_, &options, &late), PANACHE_OK);
  panache_character_destroy(late);
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
}

// The joint map of panache_skeleton_options.

using JointMap = panache::test::StickApi;

panache_status create(const std::vector<panache_joint>& joints,
                      const std::vector<panache_human_joint>& map, panache_skeleton** out) {
  panache_skeleton_options options = PANACHE_SKELETON_OPTIONS;
  options.human_joints = map.data();
  options.human_joint_count = static_cast<int32_t>(map.size());
  return panache_skeleton_create(joints.data(), static_cast<int32_t>(joints.size()), &options, out);
}

TEST_F(JointMap, says_which_joints_they_are_even_where_all_have_one_name) {
  std::vector<panache_joint> joints(stick_figure, stick_figure + STICK_JOINTS);
  for (panache_joint& joint : joints) joint.name = "joint";
  panache_skeleton* mapped = nullptr;
  ASSERT_EQ(
      create(joints, {{"head", 4}, {"leftToes", -1}, {"leftHand", 7}, {"rightHand", 10}}, &mapped),
      PANACHE_OK)
      << panache_last_error();
  EXPECT_EQ(panache_skeleton_find(mapped, "head"), 4);
  EXPECT_EQ(panache_skeleton_find(mapped, "leftHand"), 7);
  EXPECT_EQ(panache_skeleton_find(mapped, "leftToes"), -1);
  EXPECT_EQ(panache_skeleton_find(mapped, "leftUpperLeg"), 11);
  panache_skeleton_destroy(mapped);
}

TEST_F(JointMap, goes_before_the_names_of_the_joints) {
  const std::vector<panache_joint> joints(stick_figure, stick_figure + STICK_JOINTS);
  panache_skeleton* mapped = nullptr;
  ASSERT_EQ(create(joints, {{"neck", -1}}, &mapped), PANACHE_OK) << panache_last_error();
  EXPECT_EQ(panache_skeleton_find(skeleton_, "neck"), 3);
  EXPECT_EQ(panache_skeleton_find(mapped, "neck"), -1);
  panache_skeleton_destroy(mapped);
}

TEST_F(JointMap, may_say_all_there_is) {
  const std::vector<panache_joint> joints(stick_figure, stick_figure + STICK_JOINTS);
  std::vector<panache_human_joint> whole;
  for (const char* name :
       {"hips",          "spine",         "chest",         "neck",          "head",
        "leftShoulder",  "leftUpperArm",  "leftLowerArm",  "leftHand",      "rightShoulder",
        "rightUpperArm", "rightLowerArm", "rightHand",     "leftUpperLeg",  "leftLowerLeg",
        "leftFoot",      "leftToes",      "rightUpperLeg", "rightLowerLeg", "rightFoot",
        "rightToes"}) {
    whole.push_back({name, panache_skeleton_find(skeleton_, name)});
  }
  panache_skeleton* mapped = nullptr;
  ASSERT_EQ(create(joints, whole, &mapped), PANACHE_OK) << panache_last_error();
  for (const panache_human_joint& joint : whole) {
    EXPECT_EQ(panache_skeleton_find(mapped, joint.vrm_name), joint.joint) << joint.vrm_name;
  }
  panache_skeleton_destroy(mapped);
}

TEST_F(JointMap, that_is_wrong_is_rejected_with_its_entry) {
  const std::vector<panache_joint> joints(stick_figure, stick_figure + STICK_JOINTS);
  const auto rejection = [&](const std::vector<panache_human_joint>& map) {
    panache_skeleton* none = skeleton_;
    EXPECT_EQ(create(joints, map, &none), PANACHE_BAD_ARGUMENT);
    EXPECT_EQ(none, nullptr);
    return std::string(panache_last_error());
  };
  EXPECT_EQ(rejection({{"head", 4}, {"tail", 3}}),
            "human joint 1: there is no human joint 'tail' that a style turns");
  EXPECT_EQ(rejection({{nullptr, 3}}),
            "human joint 0: there is no human joint '' that a style turns");
  EXPECT_EQ(rejection({{"head", 19}}), "human joint 0 'head': joint is 19; expected -1 to 18");
  EXPECT_EQ(rejection({{"head", -2}}), "human joint 0 'head': joint is -2; expected -1 to 18");
  EXPECT_EQ(rejection({{"head", 4}, {"head", 3}}), "human joint 1 'head': is listed twice");
  EXPECT_EQ(rejection(std::vector<panache_human_joint>(22, {"head", 4})),
            "22 human joints; expected an array of 0 to 21");
  panache_skeleton_options options = PANACHE_SKELETON_OPTIONS;
  for (const int32_t count : {-1, 1}) {
    options.human_joint_count = count;
    panache_skeleton* none = nullptr;
    EXPECT_EQ(panache_skeleton_create(joints.data(), STICK_JOINTS, &options, &none),
              PANACHE_BAD_ARGUMENT);
    EXPECT_EQ(panache_last_error(),
              std::to_string(count) + " human joints; expected an array of 0 to 21");
  }
}

}  // namespace
