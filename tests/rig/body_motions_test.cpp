#include "rig/body_motions.h"

#include <gtest/gtest.h>

#include "clip/bvh.h"
#include "clip/gltf.h"
#include "clip/make_character.h"
#include "clip/rescale.h"

namespace panache {
namespace {

using test::GltfParts;
using test::Json;
using test::node_called;

// Adds an animation that turns these nodes by up to `angle` radians; the character rests in it
// elsewhere. By itself it moves nothing.
void add_animation(GltfParts& parts, const std::string& name, const std::vector<std::string>& nodes,
                   double angle) {
  const size_t animation = parts.json["animations"].size();
  parts.json["animations"].push_back({{"name", name}});
  const size_t times = parts.add_bounded(test::key_times(20), "SCALAR", 1);
  for (const std::string& node : nodes) {
    const size_t n = node_called(parts, node);
    const Json rest = parts.json["nodes"][n].value("rotation", Json::array({0, 0, 0, 1}));
    std::vector<float> turns;
    for (int i = 0; i < 20; ++i) {
      const Quatd at_rest = Quat{rest[0], rest[1], rest[2], rest[3]}.as<double>();
      test::append(turns, (at_rest * axis_angle(Vec3d{1, 0, 0}, angle * i / 20)).as<float>());
    }
    parts.add_channel(animation, n, "rotation", "LINEAR", times, parts.add(turns, "VEC4", 4));
  }
}

std::vector<std::string> moving(const GltfParts& parts) {
  const auto file = parse_gltf(test::to_glb(parts), "walk.glb");
  EXPECT_TRUE(file.ok()) << (file ? "" : file.error().message);
  std::vector<std::string> names;
  for (const int clip : find_body_motions(**file).clips) {
    names.push_back((*file)->clip_names()[static_cast<size_t>(clip)]);
  }
  return names;
}

using Names = std::vector<std::string>;

TEST(BodyMotions, animations_of_the_body_are_told_from_those_of_all_else) {
  GltfParts parts = test::character();
  add_animation(parts, "finger", {"RightHandIndex1", "RightHandIndex2"}, 0.5);
  add_animation(parts, "nod", {"Head"}, 0.5);
  add_animation(parts, "hips", {"Hips"}, 0.5);
  add_animation(parts, "sword", {"Sword"}, 0.5);
  // As exporters bake it: keys at rest for every joint.
  add_animation(parts, "baked blink", {"Hips", "Spine", "Head", "LeftArm", "LeftUpLeg"}, 0);
  // Of what glTF itself does not know: a camera, a material.
  parts.json["animations"].push_back(
      {{"name", "fade"},
       {"channels", Json::array({{{"sampler", 0},
                                  {"target",
                                   {{"path", "pointer"},
                                    {"extensions",
                                     {{"KHR_animation_pointer",
                                       Json::object({{"pointer", "/materials/0/alpha"}})}}}}}}})},
       {"samplers", parts.json["animations"][0]["samplers"]}});
  EXPECT_EQ(moving(parts), (Names{"Walk", "Wave", "nod", "hips"}));
}

TEST(BodyMotions, a_pose_away_from_the_rest_is_one_of_the_body) {
  GltfParts parts = test::character();
  add_animation(parts, "held", {"LeftArm"}, 0);
  Json& sampler = parts.json["animations"].back()["samplers"][0];
  std::vector<float> turns;
  for (int i = 0; i < 20; ++i) {
    test::append(turns, axis_angle(Vec3d{0, 0, 1}, -1.2).as<float>());
  }
  sampler["output"] = parts.add(turns, "VEC4", 4);
  EXPECT_EQ(moving(parts), (Names{"Walk", "Wave", "held"}));
}

TEST(BodyMotions, without_a_humanoid_any_joint_counts) {
  GltfParts parts = test::small_gltf();
  parts.json["animations"].push_back({{"name", "still"}});
  add_animation(parts, "lamp", {"Lamp"}, 0.5);
  EXPECT_EQ(moving(parts), (Names{"nod", "lamp"}));
}

TEST(BodyMotions, motion_of_joints_alone_is_of_the_body_even_at_rest) {
  const auto file = parse_bvh(
      "HIERARCHY\nROOT a\n{\nOFFSET 0 0 0\nCHANNELS 1 Xrotation\n}\nMOTION\nFrames: 2\nFrame Time: "
      "0.1\n0\n0\n",
      "a.bvh");
  ASSERT_TRUE(file.ok());
  EXPECT_EQ(find_body_motions(**file).clips, std::vector<int>{0});
}

TEST(BodyMotions, those_that_are_passed_over_are_named) {
  EXPECT_EQ(describe_still({"blink"}, true), "'blink' moves no joint of the humanoid");
  EXPECT_EQ(describe_still({"a", "b"}, false), "'a' and 'b' move no joint");
  EXPECT_EQ(describe_still({"a", "b", "c", "d", "e", "f"}, true),
            "'a', 'b', 'c', 'd' and 2 more move no joint of the humanoid");
}

TEST(BodyMotions, poses_are_told_by_their_names_or_their_length) {
  for (const char* name : {"T-Pose", "TPose", "tpose", "Armature|T-Pose.001", "Hero_T_Pose", "Rest",
                           "rest pose", "BindPose", "reference pose"}) {
    EXPECT_TRUE(is_pose(name, 100)) << name;
  }
  for (const char* name : {"Walk", "", "first pose", "last_pose", "Resting", "rest a while",
                           "strike a pose", "Take 001"}) {
    EXPECT_FALSE(is_pose(name, 100)) << name;
    EXPECT_TRUE(is_pose(name, 1)) << name;
  }
}

}  // namespace
}  // namespace panache
