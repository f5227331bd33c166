// A changed FBX file is the file with other curves, and a new one is what others expect.

#include <cstring>
#include <numeric>

#include <gtest/gtest.h>

#include "base/file.h"
#include "cli/same_positions.h"
#include "clip/binary_fbx.h"
#include "clip/fbx.h"
#include "clip/make_fbx6.h"
#include "clip/make_fbx_scene.h"
#include "make_clip.h"

namespace panache {
namespace {

using test::SceneLayer;
using test::SceneModel;

// Angles and places are floats in the file: half a last bit of 360 degrees is 3e-7 radians, which
// along eight joints of half a metre adds up to less than this. Metres.
constexpr float kWritten = 1e-5f;

std::unique_ptr<MotionFile> read_fbx(const std::string& bytes) {
  auto file = parse_fbx(bytes, "in.fbx");
  EXPECT_TRUE(file.ok()) << file.error().message;
  return file ? *std::move(file) : nullptr;
}

std::vector<double> own_frames(const Clip& clip) {
  std::vector<double> out(static_cast<size_t>(clip.frames));
  std::iota(out.begin(), out.end(), 0.0);
  return out;
}

// A joint turned further in all frames, or in some.
Clip with_turn(Clip clip, const std::string& name, int first = 0) {
  const Quat by = normalized(Quat{0.1f, 0.2f, -0.1f, 0.95f});
  for (int f = first; f < clip.frames; ++f) {
    for (size_t j = 0; j < clip.joints(); ++j) {
      if (clip.skeleton.joints[j].name != name) continue;
      clip.pose(f).rotations[j] = normalized(clip.pose(f).rotations[j] * by);
    }
  }
  return clip;
}

// A joint with pivots in a file with layers, scales, a mesh, a prop and morph weights, as text
// and in binary versions old and new, packed and not.
std::vector<std::string> rich_files() {
  const std::vector<SceneModel> models = {
      {"root", -1, {{"Lcl Translation", {0, 90, 0}}, {"Lcl Scaling", {2, 2, 2}}}},
      {"thigh",
       0,
       {{"Lcl Translation", {10, -5, 0}},
        {"RotationPivot", {2, 3, -4}},
        {"ScalingOffset", {-1, 2, 3}},
        {"PreRotation", {20, -30, 40}},
        {"PostRotation", {-15, 25, 5}},
        {"RotationOrder", {2}}}},
      {"shin", 1, {{"Lcl Translation", {0, -40, 0}}, {"InheritType", {2}}}},
      {"foot", 2, {{"Lcl Translation", {0, -40, 5}}}},
      {"hat", 0, {{"Lcl Translation", {8, 6, 4}}}, "Mesh"}};
  const auto line = [](double begin, double end) {
    test::SceneCurve out;
    for (int f = 0; f <= 10; ++f) {
      out.keys.push_back({static_cast<double>(f), begin + (end - begin) * f / 10});
    }
    return out;
  };
  const std::vector<test::SceneStack> stacks = {
      {"walk",
       {{"BaseLayer",
         {},
         {{0, 0, {{line(0, 30), {}, {}}}},
          {1, 1, {{line(-40, 50), line(0, 20), line(70, -10)}}},
          {2, 1, {{line(0, 40), {}, {}}}},
          {4, 1, {{{}, line(0, 120), {}}}}}},
        {"Layer2", {{"BlendMode", 0}}, {{1, 1, {{line(10, 10), line(0, 5), {}}}}}}}},
      {"other", {{"BaseLayer", {}, {{0, 0, {{line(0, 60), {}, {}}}}}}}},
  };
  std::string text = test::make_fbx_scene(models, stacks, {.centimetres = 2.54, .up_axis = 2});
  const std::string mesh =
      "\tGeometry: 1500, \"Geometry::\", \"Mesh\" {\n\t\tVertices: *9 {\n\t\t\ta: "
      "0,0,0,1,0,0,0,1.25,0\n\t\t}\n\t\tPolygonVertexIndex: *3 {\n\t\t\ta: 0,1,-3\n\t\t}\n\t}\n";
  text.insert(text.find("\tModel: 2000"), mesh);
  return {text, test::to_binary_fbx7(text, 7100, true), test::to_binary_fbx7(text, 7400, false),
          test::to_binary_fbx7(text, 7500, false), test::to_binary_fbx7(text, 7700, true)};
}

TEST(FbxWrite, an_unchanged_file_keeps_its_bytes) {
  for (const std::string& bytes : rich_files()) {
    const auto file = read_fbx(bytes);
    ASSERT_TRUE(file);
    EXPECT_TRUE(file->encode({}, EditMode::replace) == bytes);
    EXPECT_TRUE(file->encode(file->clip(), own_frames(file->clip())) == bytes);
  }
}

TEST(FbxWrite, changed_joints_are_where_they_should_be_and_layers_let_go_of_them) {
  for (const std::string& bytes : rich_files()) {
    const auto file = read_fbx(bytes);
    ASSERT_TRUE(file);
    for (const char* joint : {"root", "thigh", "shin", "foot"}) {
      SCOPED_TRACE(joint);
      Clip changed = with_turn(file->clip(), joint);
      for (int f = 0; f < changed.frames; ++f) changed.pose(f).translations[0].x += 0.5f;
      const auto again = read_fbx(file->encode(changed, own_frames(changed)));
      ASSERT_TRUE(again);
      ASSERT_EQ(again->clip_names(), file->clip_names());
      test::expect_same_positions(changed, again->clip(), kWritten);
      test::expect_same_positions(file->clip(1), again->clip(1), 0);
    }
  }
}

// The nodes of a tree as text, each with the nodes that it is in.
void list_nodes(const FbxTree& tree, const FbxNode& node, const std::string& above,
                std::vector<std::string>& out) {
  std::string line = above + "/" + std::string(node.name);
  for (const FbxValue& value : node.values) (line += " ") += value.bytes;
  out.push_back(line);
  for (const FbxNode& child : node.children) list_nodes(tree, child, line.substr(0, 80), out);
}

TEST(FbxWrite, everything_but_the_curves_of_changed_joints_keeps_its_bytes) {
  for (const std::string& bytes : rich_files()) {
    const auto file = read_fbx(bytes);
    ASSERT_TRUE(file);
    const Clip changed = with_turn(file->clip(), "shin");
    const std::string encoded = file->encode(changed, own_frames(changed));
    ASSERT_FALSE(encoded == bytes);
    const auto before = FbxTree::parse(bytes, "before"), after = FbxTree::parse(encoded, "after");
    ASSERT_TRUE(before.ok() && after.ok());
    std::vector<std::string> old_nodes, new_nodes;
    list_nodes(*before, before->root(), "", old_nodes);
    list_nodes(*after, after->root(), "", new_nodes);
    // The one curve of the shin gets other values, and two axes get curves: 8 nodes and a
    // connection each.
    std::vector<std::string> gone, come;
    std::sort(old_nodes.begin(), old_nodes.end());
    std::sort(new_nodes.begin(), new_nodes.end());
    std::set_difference(old_nodes.begin(), old_nodes.end(), new_nodes.begin(), new_nodes.end(),
                        std::back_inserter(gone));
    std::set_difference(new_nodes.begin(), new_nodes.end(), old_nodes.begin(), old_nodes.end(),
                        std::back_inserter(come));
    for (const std::string& line : gone) {
      EXPECT_NE(line.find("AnimationCurve "), std::string::npos) << line;
    }
    for (const std::string& line : come) {
      const bool is_new = line.find("AnimationCurve ") != std::string::npos ||
                          line.find("/Connections/C OP") != std::string::npos ||
                          line.find("/Connections/C ") != std::string::npos;
      EXPECT_TRUE(is_new) << line;
    }
    EXPECT_LE(gone.size(), 6u);
    if (after->is_binary()) {
      EXPECT_EQ(encoded.substr(encoded.size() - 41), bytes.substr(bytes.size() - 41));
    }
  }
}

TEST(FbxWrite, a_comma_behind_the_last_value_of_a_node_goes_with_it) {
  std::string text = rich_files().front();
  const size_t node = text.find("AnimationCurveNode: ");
  text.insert(text.find(" {", node), ", Property: \"\"");
  const auto file = read_fbx(text);
  ASSERT_TRUE(file);
  const Clip rest = file->rest();
  const ClipEdit edit = {kNewClip, &rest, {}, "still"};
  const auto again = read_fbx(file->encode({&edit, 1}, EditMode::replace));
  ASSERT_TRUE(again);
  EXPECT_FALSE(again->clip().skeleton.joints.empty());
}

TEST(FbxWrite, frames_that_do_not_change_keep_the_numbers_of_the_file) {
  for (const std::string& bytes : rich_files()) {
    const auto file = read_fbx(bytes);
    ASSERT_TRUE(file);
    const Clip changed = with_turn(file->clip(), "shin", 6);
    const auto again = read_fbx(file->encode(changed, own_frames(changed)));
    ASSERT_TRUE(again);
    for (int f = 0; f < 6; ++f) {
      const ConstPose a = file->clip().pose(f), b = again->clip().pose(f);
      for (size_t j = 0; j < changed.joints(); ++j) EXPECT_EQ(a.rotations[j], b.rotations[j]);
    }
    test::expect_same_positions(changed, again->clip(), kWritten);
  }
}

TEST(FbxWrite, new_motions_stand_beside_or_before_the_old_ones) {
  for (const std::string& bytes : rich_files()) {
    const auto file = read_fbx(bytes);
    ASSERT_TRUE(file);
    const Clip changed = with_turn(file->clip(), "thigh");
    const std::vector<double> frames = own_frames(changed);
    const ClipEdit edit = {0, &changed, frames, "walk (old 1)"};
    for (const bool first : {false, true}) {
      const auto again =
          read_fbx(file->encode({&edit, 1}, first ? EditMode::add_first : EditMode::add_beside));
      ASSERT_TRUE(again);
      const std::vector<std::string> expected =
          first ? std::vector<std::string>{"walk (old 1)", "walk", "other"}
                : std::vector<std::string>{"walk", "other", "walk (old 1)"};
      ASSERT_EQ(again->clip_names(), expected);
      test::expect_same_positions(changed, again->clip(first ? 0 : 2), kWritten);
      test::expect_same_positions(file->clip(0), again->clip(first ? 1 : 0), 0);
      test::expect_same_positions(file->clip(1), again->clip(first ? 2 : 1), 0);
    }
  }
}

TEST(FbxWrite, a_new_motion_replaces_all_of_a_character) {
  for (const std::string& bytes : rich_files()) {
    const auto file = read_fbx(bytes);
    ASSERT_TRUE(file);
    Clip motion = file->rest();
    motion.frame_time = 0.02;
    motion.resize(0);
    for (int f = 0; f < 7; ++f) motion.append(file->rest().pose(0));
    motion = with_turn(motion, "thigh", 3);
    const ClipEdit edit = {kNewClip, &motion, {}, "bow"};
    const auto again = read_fbx(file->encode({&edit, 1}, EditMode::replace));
    ASSERT_TRUE(again);
    EXPECT_EQ(again->clip_names(), std::vector<std::string>{"bow"});
    EXPECT_EQ(again->clip().frames, 7);
    // The hat, which nothing moves any more, is no joint.
    test::expect_same_positions(again->clip(), motion, kWritten);
  }
}

Clip every_other_frame(const Clip& clip) {
  Clip out = clip;
  out.resize(0);
  for (int f = 0; f < clip.frames; f += 2) out.append(clip.pose(f));
  return out;
}

TEST(FbxWrite, a_motion_of_another_tempo_takes_everything_with_it) {
  for (const std::string& bytes : rich_files()) {
    const auto file = read_fbx(bytes);
    ASSERT_TRUE(file);
    Clip slow = file->clip();
    std::vector<double> frames;
    slow.resize(0);
    std::vector<Quat> rotations(slow.joints());
    std::vector<Vec3> translations(slow.joints());
    for (int f = 0; f <= 20; ++f) {
      frames.push_back(f / 2.0);
      sample(file->clip(), frames.back(), {rotations, translations});
      slow.append({rotations, translations});
    }
    const auto again = read_fbx(file->encode(slow, frames));
    ASSERT_TRUE(again);
    // At the keys nothing is interpolated.
    test::expect_same_positions(file->clip(), every_other_frame(again->clip()), kWritten);
    // Between them the joints of the clip turn along the shortest arc, those of the file by their
    // angles. Midway that is at most (ab + bc + ca) / 8 for steps of a, b and c: 0.0044 radians for
    // the thigh's 9, 2.5 and 8 degrees, at the foot, 80 units of 5.08 cm further on.
    test::expect_same_positions(slow, again->clip(), 0.0044f * 80 * 0.0508f);
    test::expect_same_positions(file->clip(1), again->clip(1), 0);
  }
}

TEST(FbxWrite, a_new_file_has_the_clip_in_centimetres) {
  const Clip walk = test::walking_clip(20, 50);
  const Quat z_up = {0.70710678f, 0, 0, 0.70710678f};
  for (const auto& [unit, turn] : {std::pair(1.0, Quat{}), std::pair(0.0254, z_up)}) {
    const std::string bytes = format_fbx(walk.skeleton, {{&walk, "walk"}}, unit, turn);
    const auto file = read_fbx(bytes);
    ASSERT_TRUE(file);
    EXPECT_EQ(file->clip_names(), std::vector<std::string>{"walk"});
    Clip expected = walk;
    for (int f = 0; f < expected.frames; ++f) {
      const Pose pose = expected.pose(f);
      for (Vec3& position : pose.translations) position *= static_cast<float>(unit);
      pose.translations[0] = rotate(turn, pose.translations[0]);
      pose.rotations[0] = turn * pose.rotations[0];
    }
    test::expect_same_positions(expected, file->clip(), kWritten);
    for (size_t j = 0; j < walk.joints(); ++j) {
      EXPECT_EQ(file->clip().skeleton.joints[j].parent, walk.skeleton.joints[j].parent);
    }
    EXPECT_TRUE(file->encode({}, EditMode::replace) == bytes);
  }
}

TEST(FbxWrite, a_given_rate_is_that_of_every_motion) {
  for (const std::string& bytes : rich_files()) {
    const auto file = parse_fbx(bytes, "in.fbx", {.fps = 60.0});
    ASSERT_TRUE(file.ok()) << file.error().message;
    EXPECT_EQ((*file)->clip().frames, 11);
    EXPECT_NEAR((*file)->clip().frame_time, 1.0 / 60, 1e-9);
    const auto again = read_fbx((*file)->encode({}, EditMode::replace));
    ASSERT_TRUE(again);
    EXPECT_NEAR(again->clip().frame_time, 1.0 / 60, 1e-9);
    EXPECT_EQ(again->clip(1).frames, 11);
  }
}

TEST(FbxWrite, a_changed_file_of_version_6_becomes_one_of_version_7) {
  const Clip walk = test::walking_clip(20);
  const auto file = read_fbx(test::to_binary_fbx6(test::Fbx6Maker(walk, 2, 1).make()));
  ASSERT_TRUE(file);
  const Clip changed = with_turn(file->clip(), "spine");
  const std::vector<double> frames = own_frames(changed);
  const ClipEdit kept = {0, &changed, frames, "Walk (old 1)"};
  const std::string bytes = file->encode({&kept, 1}, EditMode::add_first);
  EXPECT_EQ(binary_fbx_version(bytes), 7400);
  const auto again = read_fbx(bytes);
  ASSERT_TRUE(again);
  EXPECT_EQ(again->clip_names(), (std::vector<std::string>{"Walk (old 1)", "Walk"}));
  test::expect_same_positions(changed, again->clip(), kWritten);
  test::expect_same_positions(file->clip(), again->clip(1), kWritten);
}

}  // namespace
}  // namespace panache
