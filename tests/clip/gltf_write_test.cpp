// What becomes of a glTF file whose motion was changed: all of the rest stays.

#include "gltf_checks.h"
#include "rescale.h"
#include "temporary_folder.h"

namespace panache {
namespace {

using test::accessor_floats;
using test::GltfParts;
using test::Json;
using test::node_called;
using test::small_gltf;

// The channel's sampler that moves `path` of `node`.
Json sampler_of(const Json& animation, size_t node, const std::string& path) {
  for (const Json& channel : animation["channels"]) {
    if (channel["target"]["node"] == node && channel["target"]["path"] == path) {
      return animation["samplers"][channel["sampler"].get<size_t>()];
    }
  }
  return Json();
}

// Rotations are the same where they turn alike, whatever their sign.
void expect_same_motion(const Clip& a, const Clip& b, float translation_error) {
  ASSERT_EQ(a.frames, b.frames);
  ASSERT_EQ(a.joints(), b.joints());
  EXPECT_EQ(a.frame_time, b.frame_time);
  for (size_t i = 0; i < a.rotations.size(); ++i) {
    const Quat p = a.rotations[i], q = b.rotations[i];
    EXPECT_TRUE(p == q || p == (Quat{-q.x, -q.y, -q.z, -q.w})) << i;
    EXPECT_LE(length(a.translations[i] - b.translations[i]), translation_error) << i;
  }
}

// `out` holds everything of `in`: each member and item, in order; lists may have grown at the end.
void expect_contains(const Json& out, const Json& in, const std::string& path) {
  if (path == "/buffers/0/byteLength") return;
  if (in.is_object() && out.is_object()) {
    for (const auto& [key, value] : in.items()) {
      ASSERT_TRUE(out.contains(key)) << path << "/" << key;
      expect_contains(out[key], value, path + "/" + key);
    }
    EXPECT_EQ(out.size(), in.size()) << path;
  } else if (in.is_array() && out.is_array()) {
    ASSERT_GE(out.size(), in.size()) << path;
    for (size_t i = 0; i < in.size(); ++i) {
      expect_contains(out[i], in[i], path + "/" + std::to_string(i));
    }
  } else {
    EXPECT_EQ(out, in) << path;
  }
}

TEST(GltfWrite, unchanged_motion_beside_the_old_uses_the_very_accessors_of_the_old) {
  const GltfParts in = test::glb_parts(test::to_glb(test::character()));
  const auto file = must_read(in);
  for (const int which : {0, 1}) {
    const GltfParts out =
        test::glb_parts(edited(*file, file->clip(which), EditMode::add_beside, which));
    EXPECT_EQ(out.bin, in.bin);
    EXPECT_EQ(out.json["accessors"], in.json["accessors"]);
    expect_contains(out.json, in.json, "");
    ASSERT_EQ(out.json["animations"].size(), 3u);
    Json expected = in.json["animations"][static_cast<size_t>(which)];
    expected["name"] = "new";
    EXPECT_EQ(out.json["animations"][2], expected);
  }
}

TEST(GltfWrite, unchanged_motion_in_place_of_the_old_is_the_same_file) {
  GltfParts in = test::character();
  const auto file = must_read(in);
  for (const int which : {0, 1}) {
    Clip clip = file->clip(which);
    const GltfParts out = test::glb_parts(edited(*file, clip, EditMode::replace, which));
    in.json["buffers"] = out.json["buffers"];
    EXPECT_EQ(out.json, in.json);
    EXPECT_EQ(out.bin, in.bin);
    clip.resize(20);
    EXPECT_EQ(must_read(edited(*file, clip, EditMode::replace, which))->clip(which).frames, 20);
  }
}

TEST(GltfWrite, what_is_not_motion_stays) {
  const GltfParts in =
      test::glb_parts(test::to_glb(test::character({.vrm = test::CharacterOptions::Vrm::vrm1})));
  const auto file = must_read(in);
  Clip clip = file->clip();
  turn(clip, joint_named(clip, "Head"), 0.3f);
  const GltfParts out = test::glb_parts(edited(*file, clip, EditMode::add_beside));
  expect_contains(out.json, in.json, "");
  EXPECT_TRUE(out.bin.starts_with(in.bin));
  EXPECT_EQ(out.json["animations"].size(), 3u);
  EXPECT_EQ(out.json["animations"][2]["extras"], in.json["animations"][0]["extras"]);
}

TEST(GltfWrite, only_the_changed_channels_get_new_keys) {
  const GltfParts in = test::character();
  const auto file = must_read(in);
  Clip clip = file->clip(1);
  turn(clip, joint_named(clip, "RightForeArm"), 0.3f);
  const GltfParts out = test::glb_parts(edited(*file, clip, EditMode::add_beside, 1));
  const Json &before = in.json["animations"][1], &after = out.json["animations"][2];
  ASSERT_EQ(before["channels"].size(), after["channels"].size());
  const size_t changed = node_called(in, "RightForeArm");
  for (const Json& channel : before["channels"]) {
    const size_t node = channel["target"]["node"];
    const std::string path = channel["target"]["path"];
    const Json a = sampler_of(before, node, path), b = sampler_of(after, node, path);
    if (node == changed) {
      EXPECT_NE(a["output"], b["output"]);
      EXPECT_EQ(b["interpolation"], "LINEAR");
      EXPECT_EQ(out.json["accessors"][b["output"].get<size_t>()]["count"], 61);
    } else {
      EXPECT_EQ(a, b) << node << path;
    }
  }
}

TEST(GltfWrite, a_changed_clip_reads_back) {
  for (const bool centimetres : {false, true}) {
    const auto file = must_read(test::character({.centimetres = centimetres}));
    Clip clip = file->clip();
    for (size_t j = 2; j < clip.joints(); ++j) turn(clip, j, 0.1f);
    for (int f = 0; f < clip.frames; ++f) clip.pose(f).translations[1].x += 0.125f;
    // Divided and multiplied by a scale that is no power of two, a place within 2 m is rounded
    // twice.
    const float error = centimetres ? 2 * 0x1p-23f * 2 : 0;
    const auto replaced = must_read(edited(*file, clip, EditMode::replace));
    EXPECT_EQ(replaced->clip_names(), file->clip_names());
    expect_same_motion(replaced->clip(0), clip, error);
    expect_same_motion(replaced->clip(1), file->clip(1), 0);
    const auto added = must_read(edited(*file, clip, EditMode::add_beside));
    EXPECT_EQ(added->clip_names(), (std::vector<std::string>{"Walk", "Wave", "new"}));
    expect_same_motion(added->clip(0), file->clip(0), 0);
    expect_same_motion(added->clip(2), clip, error);
  }
}

TEST(GltfWrite, every_value_that_did_not_change_keeps_its_keys_bits) {
  const GltfParts in = small_gltf();
  const auto file = must_read(in);
  Clip clip = file->clip();
  clip.pose(2).rotations[1] = axis_angle(Vec3{0, 1, 0}, 1.0f);
  const GltfParts out = test::glb_parts(edited(*file, clip, EditMode::replace));
  const Json& animation = out.json["animations"][0];
  const auto before = accessor_floats(in, in.json["animations"][0]["samplers"][0]["output"]);
  const auto after = accessor_floats(out, sampler_of(animation, 1, "rotation")["output"]);
  ASSERT_EQ(after.size(), before.size());
  for (size_t i = 0; i < before.size(); ++i) {
    EXPECT_EQ(before[i] == after[i], i / 4 != 2 || before[i] == after[i]) << i;
  }
  EXPECT_EQ(after[9], std::sin(0.5f));
  EXPECT_EQ(sampler_of(animation, 1, "translation"), in.json["animations"][0]["samplers"][1]);
}

TEST(GltfWrite, keys_that_are_not_unit_keep_their_bits_too) {
  GltfParts in = small_gltf();
  const std::vector<float> turns = {0, 0, 0, 2, 3, 0, 0, 0, 0, 0.5f, 0, 0, 0, 0, 0, 1};
  in.json["animations"][0]["samplers"][0]["output"] = in.add(turns, "VEC4", 4);
  const auto file = must_read(in);
  Clip clip = file->clip();
  clip.pose(3).rotations[1] = {1, 0, 0, 0};
  const GltfParts out = test::glb_parts(edited(*file, clip, EditMode::replace));
  const auto after =
      accessor_floats(out, sampler_of(out.json["animations"][0], 1, "rotation")["output"]);
  EXPECT_EQ(std::vector<float>(after.begin(), after.begin() + 12),
            std::vector<float>(turns.begin(), turns.begin() + 12));
}

TEST(GltfWrite, a_changed_joint_without_a_channel_gets_one) {
  const GltfParts in = small_gltf();
  const auto file = must_read(in);
  Clip clip = file->clip();
  clip.pose(1).rotations[2] = axis_angle(Vec3{0, 1, 0}, 1.0f);
  clip.pose(1).translations[2] = {0, 0.75f, 0};
  const std::string bytes = edited(*file, clip, EditMode::replace);
  const GltfParts out = test::glb_parts(bytes);
  EXPECT_EQ(out.json["animations"][0]["channels"].size(), 4u);
  const Json sampler = sampler_of(out.json["animations"][0], 2, "translation");
  const std::vector<float> expected = {0, 0.5f, 0, 0, 0.75f, 0, 0, 0.5f, 0, 0, 0.5f, 0};
  EXPECT_EQ(accessor_floats(out, sampler["output"]), expected);
  expect_same_motion(must_read(bytes)->clip(), clip, 0);
}

TEST(GltfWrite, a_node_placed_by_a_matrix_is_never_animated) {
  GltfParts in = small_gltf();
  in.json["nodes"][2] = {{"name", "Head"},
                         {"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0.5, 0, 1}}};
  const auto file = must_read(in);
  Clip clip = file->clip();
  turn(clip, 2, 0.5f);
  const GltfParts out = test::glb_parts(edited(*file, clip, EditMode::replace));
  EXPECT_EQ(out.json["animations"], in.json["animations"]);
}

TEST(GltfWrite, quaternions_do_not_jump_to_the_other_side_of_the_sphere) {
  const auto file = must_read(small_gltf());
  Clip clip = file->clip();
  for (int f = 0; f < clip.frames; ++f) {
    const Quat q = axis_angle(Vec3{0, 1, 0}, 1 + 0.1f * static_cast<float>(f));
    clip.pose(f).rotations[1] = f % 2 ? Quat{-q.x, -q.y, -q.z, -q.w} : q;
  }
  const GltfParts out = test::glb_parts(edited(*file, clip, EditMode::replace));
  const auto keys =
      accessor_floats(out, sampler_of(out.json["animations"][0], 1, "rotation")["output"]);
  for (size_t i = 4; i < keys.size(); i += 4) EXPECT_GT(keys[i + 3] * keys[i - 1], 0);
}

TEST(GltfWrite, changed_times_take_every_channel_with_them) {
  const GltfParts in = test::character();
  const auto file = must_read(in);
  const Clip& source = file->clip(1);
  // Twice as slow, a second from the middle on: frames 15 to 45 in halves.
  Clip clip;
  clip.skeleton = source.skeleton;
  clip.frame_time = source.frame_time;
  clip.resize(61);
  std::vector<double> frames;
  for (int f = 0; f < 61; ++f) {
    frames.push_back(15 + f / 2.0);
    sample(source, frames.back(), clip.pose(f));
  }
  turn(clip, joint_named(clip, "RightForeArm"), 0.25f);
  const std::string bytes = edited(*file, clip, frames, EditMode::add_beside, 1);
  const GltfParts out = test::glb_parts(bytes);
  const Json& animation = out.json["animations"][2];
  EXPECT_EQ(animation["channels"].size(), in.json["animations"][1]["channels"].size());

  // Morph weights: 0 1 0 1 0 at each half second, so 1 at frame 15 and 0 at frame 30.
  const Json weights = sampler_of(animation, node_called(in, "Body"), "weights");
  const auto values = accessor_floats(out, weights["output"]);
  ASSERT_EQ(values.size(), 61u);
  EXPECT_EQ(values[0], 1.0f);
  EXPECT_NEAR(values[15], 0.5f, 1e-6f);
  EXPECT_EQ(values[30], 0.0f);
  // What steps, steps: the index finger is bent from one second on, frame 30.
  const Json finger = sampler_of(animation, node_called(in, "RightHandIndex1"), "rotation");
  EXPECT_EQ(finger["interpolation"], "STEP");
  const auto turns = accessor_floats(out, finger["output"]);
  for (size_t f = 1; f < 61; ++f) {
    const bool jumps = !std::equal(&turns[4 * f], &turns[4 * f] + 4, &turns[4 * f - 4]);
    EXPECT_EQ(jumps, f == 30) << f;
  }
  EXPECT_FALSE(sampler_of(animation, node_called(in, "Sword"), "scale").is_null());
  // A pose of one key holds.
  EXPECT_EQ(sampler_of(animation, node_called(in, "LeftArm"), "rotation"),
            sampler_of(in.json["animations"][1], node_called(in, "LeftArm"), "rotation"));
  // All new samplers share the times.
  EXPECT_EQ(weights["input"], finger["input"]);
  EXPECT_EQ(out.json["accessors"][weights["input"].get<size_t>()]["max"][0], 2.0f);

  const Clip back = must_read(bytes)->clip(2);
  ASSERT_EQ(back.frames, clip.frames);
  const size_t arm = joint_named(clip, "RightForeArm");
  for (int f = 0; f < 61; ++f) {
    EXPECT_EQ(back.pose(f).rotations[arm], clip.pose(f).rotations[arm]) << f;
  }
}

TEST(GltfWrite, new_times_begin_where_the_old_did) {
  GltfParts in = small_gltf();
  const size_t times = in.add_bounded(test::key_times(4, 30, 2), "SCALAR", 1);
  for (Json& sampler : in.json["animations"][0]["samplers"]) sampler["input"] = times;
  const auto file = must_read(in);
  Clip clip = file->clip();
  turn(clip, 1, 0.3f);
  const GltfParts out = test::glb_parts(edited(*file, clip, EditMode::replace));
  const Json sampler = sampler_of(out.json["animations"][0], 1, "rotation");
  EXPECT_EQ(accessor_floats(out, sampler["input"]), accessor_floats(in, times));
}

TEST(GltfWrite, a_taken_name_gets_a_number) {
  const auto file = must_read(test::character());
  Clip clip = file->clip();
  const std::vector<double> frames = same_frames(clip.frames);
  const ClipEdit edits[] = {
      {0, &clip, frames, "Walk"}, {0, &clip, frames, "Walk"}, {0, &clip, frames, ""}};
  const auto back = must_read(file->encode(edits, EditMode::add_beside));
  EXPECT_EQ(back->clip_names(),
            (std::vector<std::string>{"Walk", "Wave", "Walk (2)", "Walk (3)", "animation 5"}));
}

// Of the first animation.
double first_time(const std::string& glb) {
  const test::Json json = test::glb_parts(glb).json;
  const size_t times = json["animations"][0]["samplers"][0]["input"];
  return json["accessors"][times]["min"][0];
}

TEST(GltfWrite, a_new_clip_takes_the_place_of_all_or_stands_beside_them) {
  const auto file = must_read(small_gltf());
  Clip clip = file->rest();
  clip.frame_time = 1.0 / 50;
  clip.resize(7);
  for (int f = 0; f < clip.frames; ++f) {
    std::ranges::copy(file->rest().rotations, clip.pose(f).rotations.begin());
    std::ranges::copy(file->rest().translations, clip.pose(f).translations.begin());
    clip.pose(f).rotations[1] = axis_angle(Vec3{0, 0, 1}, 0.1f * static_cast<float>(f));
  }
  const ClipEdit edits[] = {{kNewClip, &clip, {}, "Bow"}};
  const auto alone = must_read(file->encode(edits, EditMode::replace));
  EXPECT_EQ(alone->clip_names(), std::vector<std::string>{"Bow"});
  EXPECT_EQ(first_time(file->encode(edits, EditMode::replace)), 0);
  expect_same_motion(alone->clip(), clip, 0);
  const auto beside = must_read(file->encode(edits, EditMode::add_beside));
  EXPECT_EQ(beside->clip_names(), (std::vector<std::string>{"nod", "Bow"}));
  expect_same_motion(beside->clip(1), clip, 0);
}

TEST(GltfWrite, several_clips_are_edited_at_once) {
  const auto file = must_read(test::character());
  Clip walk = file->clip(0), wave = file->clip(1);
  turn(walk, joint_named(walk, "Spine"), 0.1f);
  turn(wave, joint_named(wave, "Spine"), 0.2f);
  const std::vector<double> walk_frames = same_frames(walk.frames);
  const std::vector<double> wave_frames = same_frames(wave.frames);
  const ClipEdit edits[] = {{1, &wave, wave_frames, "b"}, {0, &walk, walk_frames, "a"}};
  for (const EditMode mode : {EditMode::replace, EditMode::add_beside}) {
    const auto back = must_read(file->encode(edits, mode));
    const bool beside = mode == EditMode::add_beside;
    expect_same_motion(back->clip(beside ? 3 : 0), walk, 0);
    expect_same_motion(back->clip(beside ? 2 : 1), wave, 0);
  }
}

TEST(GltfWrite, a_file_without_animations_gets_one_where_its_pose_changes) {
  GltfParts in = small_gltf();
  in.json.erase("animations");
  const auto file = must_read(in);
  Clip clip = file->clip();
  EXPECT_FALSE(test::glb_parts(edited(*file, clip, EditMode::replace)).json.contains("animations"));
  clip.rotations[1] = {0, 1, 0, 0};
  const auto back = must_read(edited(*file, clip, EditMode::replace));
  EXPECT_EQ(back->clip_names(), std::vector<std::string>{"new"});
  EXPECT_EQ(back->clip().rotations, clip.rotations);
}

TEST(GltfWrite, text_stays_text_and_gets_its_data_in_it) {
  const std::string text = test::to_gltf_text(small_gltf());
  const auto file = must_read(text);
  EXPECT_EQ(file->encode(file->clip(), same_frames(4)), text);
  Clip clip = file->clip();
  turn(clip, 1, 0.3f);
  const std::string out = edited(*file, clip, EditMode::replace);
  const Json json = Json::parse(out);
  ASSERT_EQ(json["buffers"].size(), 2u);
  EXPECT_EQ(json["buffers"][0], Json::parse(text)["buffers"][0]);
  expect_same_motion(must_read(out)->clip(), clip, 0);
}

TEST(GltfWrite, what_was_in_other_files_is_in_the_result) {
  test::TemporaryFolder folder;
  GltfParts parts = small_gltf();
  std::vector<std::string> expected;
  const auto add = [&](const std::string& uri, const std::string& then) {
    parts.json["images"].push_back({{"uri", uri}});
    expected.push_back(then);
  };
  // Pictures are called by what they look like.
  const std::pair<std::string, std::string> pictures[] = {{"\x89PNG and so on", "image/png"},
                                                          {"\xff\xd8 and so on", "image/jpeg"},
                                                          {"RIFF and so on", "image/webp"},
                                                          {"\xabKTX and so on", "image/ktx2"},
                                                          {"anything", "application/octet-stream"}};
  parts.json["images"] = Json::array();
  for (const auto& [bytes, type] : pictures) {
    const std::string name = "picture" + std::to_string(expected.size());
    ASSERT_TRUE(write_file(folder.path() + name, bytes, false).ok());
    add(name, "data:" + type + ";base64," + test::to_base64(bytes));
  }
  // What is inside already, or not beside the file, stays.
  for (const char* uri : {"data:image/png;base64,AAAA", "gone.png", "../textures/skin.png"}) {
    add(uri, uri);
  }
  ASSERT_TRUE(write_file(folder.path() + "walk.bin", parts.bin, false).ok());
  auto file = parse_gltf(test::to_gltf_text(parts, "walk.bin"), folder.path() + "walk.gltf");
  ASSERT_TRUE(file.ok()) << file.error().message;
  const Json json = Json::parse((*file)->encode((*file)->clip(), same_frames(4)));
  for (size_t i = 0; i < expected.size(); ++i) EXPECT_EQ(json["images"][i]["uri"], expected[i]);
  EXPECT_EQ(json["buffers"][0]["uri"],
            "data:application/octet-stream;base64," + test::to_base64(parts.bin));
}

TEST(GltfWrite, unknown_chunks_of_a_glb_stay) {
  std::string glb = test::to_glb(small_gltf());
  std::string more;
  test::append_uint32(more, 4);
  more += "XTRAabcd";
  glb += more;
  std::string length;
  test::append_uint32(length, glb.size());
  glb.replace(8, 4, length);
  const auto file = must_read(glb);
  EXPECT_TRUE(file->encode(file->clip(), same_frames(4)).ends_with(more));
}

TEST(GltfWrite, channels_of_extensions_stay) {
  GltfParts in = small_gltf();
  add_extension_channel(in);
  const auto file = must_read(in);
  Clip clip = file->clip();
  turn(clip, 1, 0.5f);
  const GltfParts out = test::glb_parts(edited(*file, clip, EditMode::replace));
  const Json& animation = out.json["animations"][0];
  ASSERT_EQ(animation["channels"].size(), 3u);
  EXPECT_EQ(animation["channels"][2]["target"], in.json["animations"][0]["channels"][2]["target"]);
  EXPECT_EQ(animation["samplers"][animation["channels"][2]["sampler"].get<size_t>()],
            in.json["animations"][0]["samplers"][0]);
}

}  // namespace
}  // namespace panache
