// What a glTF file means as a skeleton and its motion.

#include "base/file.h"
#include "gltf_checks.h"
#include "temporary_folder.h"

namespace panache {
namespace {

using test::GltfParts;
using test::Json;
using test::key_times;
using test::small_gltf;

// The small file with this channel of the hips alone.
GltfParts with_channel(const char* path, const std::vector<float>& times,
                       const std::vector<float>& values, const char* interpolation) {
  GltfParts parts = small_gltf();
  parts.json["animations"][0].erase("channels");
  parts.json["animations"][0].erase("samplers");
  const size_t input = parts.add_bounded(times, "SCALAR", 1);
  const size_t numbers = path == std::string("rotation") ? 4 : 3;
  parts.add_channel(0, 1, path, interpolation, input,
                    parts.add(values, numbers == 4 ? "VEC4" : "VEC3", numbers));
  return parts;
}
GltfParts with_turns(const std::vector<float>& times, const std::vector<Quat>& turns,
                     const char* interpolation) {
  std::vector<float> values;
  for (const Quat q : turns) test::append(values, q);
  return with_channel("rotation", times, values, interpolation);
}
GltfParts with_times(const std::vector<float>& times) {
  std::vector<Quat> turns;
  for (size_t i = 0; i < times.size(); ++i) {
    turns.push_back(axis_angle(Vec3{1, 0, 0}, 0.1f * static_cast<float>(i)));
  }
  return with_turns(times, turns, "LINEAR");
}

Quat about_x(double angle) { return axis_angle(Vec3d{1, 0, 0}, angle).as<float>(); }

TEST(GltfRead, nodes_of_skins_and_all_above_them_are_joints) {
  const auto file = must_read(small_gltf());
  ASSERT_EQ(file->clip_names(), std::vector<std::string>{"nod"});
  const Clip& clip = file->clip();
  ASSERT_EQ(clip.joints(), 3u);
  const auto& joints = clip.skeleton.joints;
  EXPECT_EQ(joints[0].name, "Armature");
  EXPECT_EQ(joints[1].name, "Hips");
  EXPECT_EQ(joints[2].name, "Head");
  EXPECT_EQ(joints[0].parent, -1);
  EXPECT_EQ(joints[1].parent, 0);
  EXPECT_EQ(joints[2].parent, 1);
  EXPECT_EQ(joints[2].offset, (Vec3{0, 0.5f, 0}));
  for (const Joint& joint : joints) EXPECT_TRUE(joint.can_rotate);
  EXPECT_TRUE(joints[0].can_translate);
  EXPECT_TRUE(joints[1].can_translate);
  EXPECT_FALSE(joints[2].can_translate);
}

TEST(GltfRead, keys_on_frames_come_bit_for_bit) {
  const Clip clip = must_read(small_gltf())->clip();
  ASSERT_EQ(clip.frames, 4);
  EXPECT_EQ(clip.frame_time, 1.0 / 30);
  for (int f = 0; f < 4; ++f) {
    EXPECT_EQ(clip.pose(f).rotations[1], about_x(0.2 * f));
    EXPECT_EQ(clip.pose(f).translations[1], (Vec3{0.1f * static_cast<float>(f), 1, 0}));
    EXPECT_EQ(clip.pose(f).rotations[2], Quat{});
    EXPECT_EQ(clip.pose(f).translations[2], clip.skeleton.joints[2].offset);
  }
}

TEST(GltfRead, text_and_binary_mean_the_same) {
  const auto binary = must_read(small_gltf());
  const auto text = must_read(test::to_gltf_text(small_gltf()));
  EXPECT_EQ(binary->clip().rotations, text->clip().rotations);
  EXPECT_EQ(binary->clip().translations, text->clip().translations);
  const auto marked = must_read("\xef\xbb\xbf" + test::to_gltf_text(small_gltf()));
  EXPECT_EQ(binary->clip().rotations, marked->clip().rotations);
}

TEST(GltfRead, data_in_files_beside_the_file_is_found) {
  test::TemporaryFolder folder;
  const GltfParts parts = small_gltf();
  ASSERT_TRUE(write_file(folder.path() + "data/the motion.bin", parts.bin, false).ok());
  ASSERT_TRUE(write_file(folder.path() + "walk.gltf",
                         test::to_gltf_text(parts, "data/the%20motion.bin"), false)
                  .ok());
  auto file = read_motion(folder.path() + "walk.gltf");
  ASSERT_TRUE(file.ok()) << file.error().message;
  EXPECT_EQ((*file)->clip().rotations, must_read(parts)->clip().rotations);
}

TEST(GltfRead, step_keys_hold_and_linear_keys_turn_at_constant_speed) {
  // Keys at 0 and 1 s give frames at 24 a second in between.
  const std::vector<Quat> turns = {about_x(0), about_x(2)};
  const Clip step = must_read(with_turns({0, 1}, turns, "STEP"))->clip();
  ASSERT_EQ(step.frames, 25);
  EXPECT_EQ(step.pose(23).rotations[1], about_x(0));
  EXPECT_EQ(step.pose(24).rotations[1], about_x(2));
  const Clip linear = must_read(with_turns({0, 1}, turns, "LINEAR"))->clip();
  for (int f = 0; f <= 24; ++f) {
    // Two roundings of a unit quaternion to floats, 2^-24 each of its components, turn it by less
    // than 4 times that.
    EXPECT_LT(angle_between(linear.pose(f).rotations[1], about_x(2.0 * f / 24)), 4 * 0x1p-24) << f;
  }
}

TEST(GltfRead, linear_keys_on_either_side_of_the_sphere_go_the_shorter_way) {
  const Quat q = about_x(0.6);
  const std::vector<Quat> turns = {about_x(0.2), {-q.x, -q.y, -q.z, -q.w}};
  const Clip clip = must_read(with_turns({0, 1}, turns, "LINEAR"))->clip();
  EXPECT_LT(angle_between(clip.pose(12).rotations[1], about_x(0.4)), 4 * 0x1p-24);
}

TEST(GltfRead, cubic_keys_follow_their_tangents) {
  // x(t) = t^3 - 2 t^2 + 3 t + 1 over 2 seconds, which a Hermite spline holds exactly.
  const auto x = [](double t) { return t * t * t - 2 * t * t + 3 * t + 1; };
  const auto slope = [](double t) { return static_cast<float>(3 * t * t - 4 * t + 3); };
  const std::vector<float> values = {
      9,        9, 9, static_cast<float>(x(0)), 0, 0, slope(0), 0, 0,
      slope(2), 0, 0, static_cast<float>(x(2)), 0, 0, 9,        9, 9};
  const Clip clip = must_read(with_channel("translation", {0, 2}, values, "CUBICSPLINE"))->clip();
  ASSERT_EQ(clip.frames, 49);
  for (int f = 0; f < clip.frames; ++f) {
    const Vec3 position = clip.pose(f).translations[1];
    // Computed in doubles from exact keys, then rounded once.
    EXPECT_EQ(position.x, static_cast<float>(x(f / 24.0))) << f;
    EXPECT_EQ(position.y, 0);
  }
}

TEST(GltfRead, whole_numbers_stand_for_fractions) {
  // Turns as the largest number, the smallest and the one above it where there is a sign.
  const auto turns_of = [](auto numbers, int type) {
    GltfParts parts = small_gltf();
    const size_t packed = parts.add(numbers, "VEC4", 4);
    parts.json["accessors"][packed]["normalized"] = true;
    if (type) parts.json["accessors"][packed]["componentType"] = type;
    parts.json["animations"][0]["samplers"][0]["output"] = packed;
    const Clip clip = must_read(parts)->clip();
    std::vector<Quat> out;
    for (int f = 0; f < 4; ++f) out.push_back(clip.pose(f).rotations[1]);
    return out;
  };
  const std::vector<Quat> with_sign = {{}, {1, 0, 0, 0}, {0, -1, 0, 0}, {0, 0, 0, -1}};
  EXPECT_EQ(turns_of(std::vector<int16_t>{0, 0, 0, 32767, 32767, 0, 0, 0, 0, -32768, 0, 0, 0, 0, 0,
                                          -32767},
                     0),
            with_sign);
  constexpr int kSignedByte = 5120;  // 128 is -128, 129 is -127.
  EXPECT_EQ(turns_of(std::vector<uint8_t>{0, 0, 0, 127, 127, 0, 0, 0, 0, 128, 0, 0, 0, 0, 0, 129},
                     kSignedByte),
            with_sign);
  const std::vector<Quat> without = {{}, {1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}};
  EXPECT_EQ(
      turns_of(std::vector<uint8_t>{0, 0, 0, 255, 255, 0, 0, 0, 0, 255, 0, 0, 0, 0, 255, 0}, 0),
      without);
}

TEST(GltfRead, a_stride_skips_what_lies_between) {
  GltfParts parts = small_gltf();
  std::vector<float> positions;
  for (int i = 0; i < 4; ++i) {
    test::append(positions, Vec3{static_cast<float>(i), 2, 3});
    test::append(positions, Vec3{-7, -7, -7});
  }
  const size_t output = parts.add(positions, "VEC3", 3);
  parts.json["accessors"][output]["count"] = 4;
  parts.json["bufferViews"].back()["byteStride"] = 24;
  parts.json["animations"][0]["samplers"][1]["output"] = output;
  const Clip clip = must_read(parts)->clip();
  for (int f = 0; f < 4; ++f) {
    EXPECT_EQ(clip.pose(f).translations[1], (Vec3{static_cast<float>(f), 2, 3}));
  }
}

TEST(GltfRead, sparse_numbers_replace_their_own_and_the_rest_is_zero_without_a_view) {
  GltfParts parts = small_gltf();
  const size_t indices = parts.add_view("\x02");
  const std::vector<float> position = {4, 5, 6};
  parts.add(position, "VEC3", 3);
  const size_t values = parts.json["accessors"].back()["bufferView"];
  const size_t output = parts.json["animations"][0]["samplers"][1]["output"];
  Json& accessor = parts.json["accessors"][output];
  accessor.erase("bufferView");
  accessor["sparse"]["count"] = 1;
  accessor["sparse"]["indices"] = {{"bufferView", indices}, {"componentType", 5121}};
  accessor["sparse"]["values"]["bufferView"] = values;
  const Clip clip = must_read(parts)->clip();
  EXPECT_EQ(clip.pose(1).translations[1], (Vec3{0, 0, 0}));
  EXPECT_EQ(clip.pose(2).translations[1], (Vec3{4, 5, 6}));
  EXPECT_EQ(clip.pose(3).translations[1], (Vec3{0, 0, 0}));
}

TEST(GltfRead, the_densest_channel_gives_the_rate) {
  const auto rate = [](const std::vector<float>& times) {
    return 1 / must_read(with_times(times))->clip().frame_time;
  };
  // A whole rate comes out as that, not as what rounded times add up to.
  EXPECT_EQ(rate(key_times(1000, 60)), 1 / (1.0 / 60));
  EXPECT_EQ(rate(key_times(100, 24)), 1 / (1.0 / 24));
  EXPECT_NEAR(rate(key_times(1000, 23.976f)), 23.976, 23.976 * 0x1p-22);
  // Keys on a rate of which some were left out.
  EXPECT_EQ(rate({0, 1 / 30.f, 2 / 30.f, 3 / 30.f, 7 / 30.f, 20 / 30.f, 21 / 30.f}),
            1 / (1.0 / 30));
  // Poses to move between get frames.
  EXPECT_EQ(rate({0, 1, 2, 3}), 1 / (1.0 / 24));
  EXPECT_EQ(rate(key_times(20, 12)), 1 / (1.0 / 12 / 2));
  // Keys on no rate: theirs, within the usual ones.
  EXPECT_NEAR(rate({0, 0.0213f, 0.0397f, 0.0628f, 0.0817f}), 1 / 0.0213, 1e-3);
  EXPECT_EQ(rate({0, 0.311f, 0.717f, 1.4f}), 1 / (1.0 / 24));
  EXPECT_EQ(rate({0, 0.00311f, 0.00717f, 0.0141f}), 1 / (1.0 / 120));
}

TEST(GltfRead, a_pose_held_by_two_keys_does_not_give_the_rate) {
  const Quat held = about_x(0.5);
  const Clip clip = must_read(with_turns({0, 2}, {held, held}, "LINEAR"))->clip();
  EXPECT_EQ(clip.frame_time, 1.0 / 30);
  EXPECT_EQ(clip.frames, 61);
  EXPECT_EQ(clip.pose(60).rotations[1], held);
}

TEST(GltfRead, frames_begin_at_the_first_key_and_reach_the_last) {
  const auto file = must_read(with_times({1.5f, 1.6f, 1.7f, 1.75f, 1.8f, 1.85f}));
  EXPECT_EQ(file->clip().frames, 8);  // At 20 a second.
  EXPECT_EQ(file->clip().pose(0).rotations[1], about_x(0));
  EXPECT_LT(angle_between(file->clip().pose(7).rotations[1], about_x(0.5)), 4 * 0x1p-24);
  EXPECT_EQ(must_read(with_times({0.7f}))->clip().frames, 1) << "of a single key";
}

TEST(GltfRead, a_file_without_animations_is_a_rest_pose) {
  GltfParts parts = small_gltf();
  parts.json.erase("animations");
  const auto file = must_read(parts);
  EXPECT_TRUE(file->clip_names().empty());
  ASSERT_EQ(file->clip().frames, 1);
  EXPECT_EQ(file->clip().pose(0).translations[1], (Vec3{0, 1, 0}));
}

TEST(GltfRead, clips_without_names_are_numbered_and_names_given_twice_are_told_apart) {
  GltfParts parts = small_gltf();
  Json& list = parts.json["animations"];
  const Json nod = list[0];
  for (int i = 0; i < 5; ++i) list.push_back(nod);
  list[1].erase("name");
  list[4]["name"] = "nod (2)";
  list[5]["name"] = "";
  const std::vector<std::string> names = {"nod",     "animation 2", "nod (2)",
                                          "nod (3)", "nod (2) (2)", "animation 6"};
  EXPECT_EQ(must_read(parts)->clip_names(), names);
}

TEST(GltfRead, nodes_without_names_are_called_by_their_number) {
  GltfParts parts = small_gltf();
  parts.json["nodes"][2].erase("name");
  EXPECT_EQ(must_read(parts)->clip().skeleton.joints[2].name, "node 2");
}

TEST(GltfRead, an_animated_node_outside_of_skins_is_a_joint) {
  GltfParts parts = small_gltf();
  parts.json["animations"][0]["channels"][1]["target"]["node"] = 3;
  const Clip clip = must_read(parts)->clip();
  const size_t lamp = joint_named(clip, "Lamp");
  EXPECT_EQ(clip.skeleton.joints[lamp].parent, -1);
  EXPECT_EQ(clip.pose(3).translations[lamp], (Vec3{0.3f, 1, 0}));
}

// What hangs on the hips, and they themselves, stay with the legs and the spine that they carry.
TEST(GltfRead, hips_that_are_in_no_skin_stay_in_the_tree) {
  GltfParts parts = test::character();
  Json& joints = parts.json["skins"][0]["joints"];
  ASSERT_EQ(joints[0], 1);
  joints[0] = 2;  // What followed the hips follows the spine.
  const auto plain = must_read(test::character()), file = must_read(parts);
  ASSERT_TRUE(plain && file);
  ASSERT_EQ(file->clip().joints(), plain->clip().joints());
  for (size_t j = 0; j < plain->clip().joints(); ++j) {
    EXPECT_EQ(file->clip().skeleton.joints[j].parent, plain->clip().skeleton.joints[j].parent);
  }
}

TEST(GltfRead, a_matrix_is_taken_apart_and_stays_put) {
  GltfParts parts = small_gltf();
  // A quarter turn about y, twice the size, at (1, 2, 3).
  parts.json["nodes"][0]["matrix"] = {0, 0, -2, 0, 0, 2, 0, 0, 2, 0, 0, 0, 1, 2, 3, 1};
  const Clip clip = must_read(parts)->clip();
  const Joint& joint = clip.skeleton.joints[0];
  EXPECT_FALSE(joint.can_rotate);
  EXPECT_FALSE(joint.can_translate);
  EXPECT_EQ(joint.offset, (Vec3{1, 2, 3}));
  EXPECT_LT(angle_between(joint.rest, rotation_y(1.57079632679f)), 1e-7);
  EXPECT_EQ(clip.skeleton.joints[1].offset, (Vec3{0, 2, 0}));
  EXPECT_EQ(clip.pose(2).translations[1], (Vec3{0.4f, 2, 0}));
}

TEST(GltfRead, an_armature_in_centimetres_stands_as_the_one_in_metres_does) {
  const auto metres = must_read(test::character());
  const auto centimetres = must_read(test::character({.centimetres = true}));
  for (const int which : {0, 1}) {
    const Clip &a = metres->clip(which), &b = centimetres->clip(which);
    ASSERT_EQ(a.frames, b.frames);
    ASSERT_EQ(a.joints(), b.joints());
    for (int f = 0; f < a.frames; ++f) {
      const std::vector<Vec3> at = world_positions(a, f), also = world_positions(b, f);
      for (size_t j = 0; j < at.size(); ++j) {
        // The way from the root to a fingertip is 11 joints within 2 m, each rounded a few times.
        EXPECT_LT(length(at[j] - also[j]), 2 * 11 * 4 * 0x1p-23f) << f << " " << j;
      }
    }
  }
}

TEST(GltfRead, the_humanoid_of_a_vrm_names_its_joints) {
  using enum test::CharacterOptions::Vrm;
  for (const auto vrm : {vrm0, vrm1}) {
    const Clip clip = must_read(test::character({.vrm = vrm}))->clip();
    const auto role = [&](const char* name) {
      return clip.skeleton.joints[joint_named(clip, name)].role;
    };
    EXPECT_EQ(role("Hips"), "hips");
    EXPECT_EQ(role("LeftArm"), "leftUpperArm");
    EXPECT_EQ(role("RightHandLittle3"), "rightLittleDistal");
    // VRM 0.x counts the thumb's joints otherwise.
    EXPECT_EQ(role("LeftHandThumb1"), "leftThumbMetacarpal");
    EXPECT_EQ(role("LeftHandThumb2"), "leftThumbProximal");
    EXPECT_EQ(role("LeftHandThumb3"), "leftThumbDistal");
    EXPECT_EQ(role("LeftForeArmTwist"), "");
    EXPECT_EQ(role("Armature"), "");
  }
  const Clip plain = must_read(test::character())->clip();
  for (const Joint& joint : plain.skeleton.joints) EXPECT_EQ(joint.role, "");
}

TEST(GltfRead, expressions_and_the_gaze_of_a_vrm_animation_are_no_joints) {
  GltfParts parts = test::small_gltf();
  for (const char* name : {"happy", "wink", "gaze"}) {
    const size_t node = parts.json["nodes"].size();
    parts.json["nodes"].push_back({{"name", name}});
    parts.add_channel(0, node, "translation", "LINEAR", 0, 2);
  }
  const auto joints = [&] { return must_read(parts)->clip().joints(); };
  EXPECT_EQ(joints(), 6u);  // Three of the body, and as many that are animated.
  test::Json& vrma = parts.json["extensions"]["VRMC_vrm_animation"];
  vrma["expressions"]["preset"]["happy"]["node"] = 4;
  vrma["expressions"]["custom"]["wink"]["node"] = 5;
  vrma["lookAt"]["node"] = 6;
  EXPECT_EQ(joints(), 3u);
  // What is a joint as well stays one.
  vrma["lookAt"]["node"] = 2;
  EXPECT_EQ(joints(), 4u);
}

TEST(GltfRead, only_the_top_of_the_skin_moves_where_nothing_else_is_animated_to_move) {
  const auto file = must_read(test::character());
  for (const int which : {0, 1}) {
    for (const Joint& joint : file->clip(which).skeleton.joints) {
      EXPECT_EQ(joint.can_translate, joint.name == "Armature" || joint.name == "Hips");
    }
  }
}

TEST(GltfRead, skins_say_what_follows_each_joint) {
  test::GltfParts parts = test::character();
  const auto weight_of = [](const test::GltfParts& from, const std::string& name) {
    const Clip clip = must_read(from)->clip();
    const Joint& joint = clip.skeleton.joints[joint_named(clip, name)];
    EXPECT_EQ(joint.skin, joint.skin_weight > 0 ? 0 : -1) << name;
    return joint.skin_weight;
  };
  // A box has 24 corners; half of them hang half on the bone above, and those of the next one
  // likewise on this.
  EXPECT_EQ(weight_of(parts, "LeftHandIndex3"), 18);
  EXPECT_EQ(weight_of(parts, "LeftHandIndex2"), 24);
  EXPECT_EQ(weight_of(parts, "Armature"), 0);
  EXPECT_EQ(weight_of(parts, "Sword"), 0);
  // Another mesh of the same skin counts as well, one of another skin on the same joints does not.
  test::Json body;
  for (const test::Json& node : parts.json["nodes"]) {
    if (node.contains("skin")) body = node;
  }
  test::GltfParts more = parts;
  more.json["nodes"].push_back(body);
  EXPECT_EQ(weight_of(more, "LeftHandIndex3"), 2 * 18);
  more.json["skins"].push_back(more.json["skins"][0]);
  more.json["nodes"].back()["skin"] = 1;
  EXPECT_EQ(weight_of(more, "LeftHandIndex3"), 18);
  // A vertex may have more than four joints.
  test::GltfParts eight_joints = parts;
  test::Json& attributes = eight_joints.json["meshes"][0]["primitives"][0]["attributes"];
  attributes["JOINTS_1"] = attributes["JOINTS_0"];
  attributes["WEIGHTS_1"] = attributes["WEIGHTS_0"];
  EXPECT_EQ(weight_of(eight_joints, "LeftHandIndex3"), 2 * 18);
  // What cannot be read says nothing.
  parts.json["meshes"][0]["primitives"][0]["attributes"]["WEIGHTS_0"] = 999;
  EXPECT_EQ(weight_of(parts, "LeftHandIndex3"), 0);
}

}  // namespace
}  // namespace panache
