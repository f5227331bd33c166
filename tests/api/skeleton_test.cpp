// The joint map of panache_skeleton_options.
#include "stick_api.h"

namespace {

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
