// The skin and the mesh of GLB files that are made of joints alone.

#include "clip/gltf_encode.h"

#include <set>

#include "gltf_checks.h"
#include "make_clip.h"
#include "rig/body_mesh.h"

namespace panache {
namespace {

using test::GltfParts;
using test::Json;

// The nodes that a skin of the file does not have as joints, but for the one that carries the mesh.
std::set<std::string> outside_of_skin(const Json& json) {
  std::set<std::string> out;
  for (const Json& node : json["nodes"]) {
    if (!node.contains("mesh")) out.insert(node["name"].get<std::string>());
  }
  for (const Json& joint : json["skins"][0]["joints"]) {
    out.erase(json["nodes"][joint.get<size_t>()]["name"].get<std::string>());
  }
  return out;
}

// A walk with fingers, a jaw and an End Site on each, which no humanoid of ours has.
Clip walk_with_fingers(int frames) {
  const Clip walk = test::walking_clip(frames);
  Clip out = walk;
  for (const auto& [name, above] :
       {std::pair{"LeftIndex1", HumanJoint::left_hand},
        std::pair{"RightThumb1", HumanJoint::right_hand}, std::pair{"Jaw", HumanJoint::head}}) {
    Joint joint;
    joint.name = name;
    joint.parent = index(above);
    joint.offset = {0, 0, 0.1f};
    joint.can_rotate = true;
    joint.ends = {{0, 0.02f, 0.03f}};
    out.skeleton.joints.push_back(joint);
  }
  out.resize(frames);
  for (int f = 0; f < frames; ++f) {
    for (size_t j = 0; j < out.joints(); ++j) {
      const bool is_new = j >= walk.joints();
      out.pose(f).rotations[j] = is_new ? Quat{} : walk.pose(f).rotations[j];
      out.pose(f).translations[j] =
          is_new ? out.skeleton.joints[j].offset : walk.pose(f).translations[j];
    }
  }
  return out;
}

// The file as programs write it that leave the mesh out: nodes and animations.
std::string joints_alone(const Clip& clip) {
  GltfParts parts = test::glb_parts(format_glb(clip, "walk", 1, {}));
  parts.json.erase("skins");
  parts.json.erase("meshes");
  Json nodes = Json::array();
  for (Json node : parts.json["nodes"]) {
    node.erase("extras");
    if (!node.contains("mesh")) nodes.push_back(std::move(node));
  }
  parts.json["nodes"] = std::move(nodes);
  parts.json["scenes"][0]["nodes"] = {0};
  return test::to_glb(parts);
}

std::optional<SkinnedBody> body_of(const MotionFile& file) {
  const Result<Rig> rig = Rig::create(file.clip());
  if (!rig) return {};
  return make_rig_body(*rig, file.clip().pose(0));
}

// There is a matrix for each joint of the skin.
void expect_a_bind_for_each_joint(const std::string& bytes) {
  const GltfParts parts = test::glb_parts(bytes);
  const size_t accessor = parts.json["skins"][0]["inverseBindMatrices"].get<size_t>();
  EXPECT_EQ(parts.json["accessors"][accessor]["count"].get<size_t>(),
            parts.json["skins"][0]["joints"].size());
  EXPECT_EQ(parts.json["accessors"][accessor]["type"], "MAT4");
}

TEST(GltfFigure, the_skin_of_a_new_file_has_fingers_face_and_ends) {
  const Clip clip = walk_with_fingers(3);
  const SkinnedBody body = make_rig_body(*Rig::create(clip), clip.pose(0));
  for (const SkinnedBody* shown : {&body, static_cast<const SkinnedBody*>(nullptr)}) {
    const std::string bytes = format_glb(clip, "walk", 0.01, {}, shown);
    const GltfParts parts = test::glb_parts(bytes);
    ASSERT_EQ(parts.json["skins"].size(), 1u);
    EXPECT_EQ(outside_of_skin(parts.json), std::set<std::string>{"walk"});
    expect_a_bind_for_each_joint(bytes);
    // Ends are ends again, not joints, so that the skeleton is what it was.
    const auto file = must_read(bytes);
    ASSERT_EQ(file->clip().joints(), clip.joints() + 1);
    for (size_t j = 0; j < clip.joints(); ++j) {
      const size_t at = joint_named(file->clip(), clip.skeleton.joints[j].name);
      const std::vector<Vec3>&in = clip.skeleton.joints[j].ends,
            &out = file->clip().skeleton.joints[at].ends;
      ASSERT_EQ(in.size(), out.size());
      for (size_t e = 0; e < in.size(); ++e) EXPECT_LT(length(in[e] * 0.01f - out[e]), 1e-7f);
    }
  }
}

TEST(GltfFigure, joints_alone_become_a_character) {
  const std::string bytes = joints_alone(walk_with_fingers(20));
  for (const bool has_body : {true, false}) {
    const Result<std::string> out =
        whole_character(bytes, "walk.glb", true, [&](const MotionFile& file) {
          return has_body ? body_of(file) : std::optional<SkinnedBody>();
        });
    ASSERT_TRUE(out.ok()) << out.error().message;
    const GltfParts parts = test::glb_parts(*out);
    ASSERT_EQ(parts.json["skins"].size(), 1u);
    EXPECT_EQ(outside_of_skin(parts.json), std::set<std::string>{"walk"});
    ASSERT_EQ(parts.json["meshes"].size(), 1u);
    EXPECT_EQ(parts.json["meshes"][0]["name"], has_body ? "body" : "sticks");
    // The motion is the same.
    const auto before = must_read(bytes), after = must_read(*out);
    ASSERT_EQ(after->clip_names(), before->clip_names());
    for (int f = 0; f < before->clip().frames; ++f) {
      const std::vector<Vec3> positions = world_positions(after->clip(), f);
      for (size_t j = 0; j < before->clip().joints(); ++j) {
        const size_t at = joint_named(after->clip(), before->clip().skeleton.joints[j].name);
        EXPECT_EQ(positions[at], world_positions(before->clip(), f)[j]);
      }
    }
    // Once is enough.
    const Result<std::string> again =
        whole_character(*out, "walk.glb", false, [](const MotionFile&) {
          ADD_FAILURE() << "a body for a file that has one";
          return std::optional<SkinnedBody>();
        });
    ASSERT_TRUE(again.ok());
    EXPECT_TRUE(*again == *out);
  }
}

TEST(GltfFigure, what_else_is_in_the_file_does_no_harm) {
  const std::string bytes = joints_alone(test::walking_clip(20));
  for (const char* text :
       {R"({"materials":7,"meshes":"a","scenes":7,"scene":-1})", R"({"scenes":[7],"scene":0})",
        R"({"scenes":[{"nodes":0}]})", R"({"scenes":[{}],"scene":9})", R"({"scenes":[]})"}) {
    GltfParts parts = test::glb_parts(bytes);
    const Json odd = Json::parse(text);
    for (const auto& [key, value] : odd.items()) parts.json[key] = value;
    // Another tree, with more joints than the body's.
    for (size_t i = 0; i < 60; ++i) {
      const size_t next = parts.json["nodes"].size() + 1;
      parts.json["nodes"].push_back({{"name", "chain " + std::to_string(i)}});
      if (i + 1 < 60) parts.json["nodes"].back()["children"] = {next};
    }
    const size_t times = parts.add_bounded({0, 0.1f}, "SCALAR", 1);
    parts.add_channel(0, parts.json["nodes"].size() - 60, "translation", "LINEAR", times,
                      parts.add(std::vector<float>{0, 0, 0, 0, 1, 0}, "VEC3", 3));
    const Result<std::string> out = whole_character(test::to_glb(parts), "walk.glb", true, body_of);
    ASSERT_TRUE(out.ok()) << out.error().message;
    const GltfParts whole = test::glb_parts(*out);
    ASSERT_EQ(whole.json["skins"].size(), 1u) << text;
    EXPECT_EQ(outside_of_skin(whole.json).count("chain 0"), 1u);
    EXPECT_EQ(outside_of_skin(whole.json).count("hips"), 0u);
    EXPECT_EQ(must_read(*out)->clip_names().size(), 1u);
  }
}

TEST(GltfFigure, a_skin_gets_the_joints_that_no_vertex_follows) {
  const Clip clip = walk_with_fingers(3);
  GltfParts parts = test::glb_parts(format_glb(clip, "walk", 1, {}));
  Json& joints = parts.json["skins"][0]["joints"];
  const size_t all = joints.size(), kept = all - 8;
  joints.erase(joints.begin() + static_cast<std::ptrdiff_t>(kept), joints.end());
  const size_t accessor = parts.json["skins"][0]["inverseBindMatrices"].get<size_t>();
  parts.json["accessors"][accessor]["count"] = kept;
  const auto none = [](const MotionFile&) { return std::optional<SkinnedBody>(); };
  const Result<std::string> out = whole_character(test::to_glb(parts), "walk.glb", true, none);
  ASSERT_TRUE(out.ok()) << out.error().message;
  const GltfParts whole = test::glb_parts(*out);
  EXPECT_EQ(whole.json["skins"][0]["joints"].size(), all);
  EXPECT_EQ(outside_of_skin(whole.json), std::set<std::string>{"walk"});
  const size_t now = whole.json["skins"][0]["inverseBindMatrices"].get<size_t>();
  EXPECT_EQ(whole.json["accessors"][now]["count"].get<size_t>(), all);
}

TEST(GltfFigure, a_character_with_a_mesh_of_its_own_stays_as_it_is) {
  const std::string bytes = test::to_glb(test::character());
  const auto none = [](const MotionFile&) { return std::optional<SkinnedBody>(); };
  const Result<std::string> out = whole_character(bytes, "hero.glb", false, none);
  ASSERT_TRUE(out.ok());
  EXPECT_TRUE(*out == bytes);
  // Rigid parts that hang on joints without a skin are something to see, too.
  GltfParts parts = test::glb_parts(joints_alone(test::walking_clip(3)));
  const size_t positions = parts.add_bounded({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3", 3);
  parts.json["meshes"] = {{{"primitives", {{{"attributes", {{"POSITION", positions}}}}}}}};
  parts.json["nodes"][2]["mesh"] = 0;
  const std::string rigid = test::to_glb(parts);
  const Result<std::string> same = whole_character(rigid, "robot.glb", true, none);
  ASSERT_TRUE(same.ok());
  EXPECT_TRUE(*same == rigid);
}

}  // namespace
}  // namespace panache
