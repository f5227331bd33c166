// GLB files for clips that came from elsewhere.

#include <gtest/gtest.h>

#include "clip/gltf_json.h"
#include "gltf_checks.h"
#include "make_clip.h"
#include "rig/body_mesh.h"

namespace panache {
namespace {

using test::GltfParts;

Clip bvh_clip(const char* fixture) { return must_parse(read_fixture(fixture))->clip(); }

constexpr double kCentimetre = 0.01;
const Quat kZUp = axis_angle(Vec3d{1, 0, 0}, -1.5707963267948966).as<float>();

TEST(GltfFormat, a_clip_reads_back_under_a_node_of_its_name) {
  for (const char* fixture : kBvhFixtures) {
    const Clip clip = bvh_clip(fixture);
    const auto file = must_read(format_glb(clip, "a walk", kCentimetre, kZUp));
    ASSERT_EQ(file->clip_names(), std::vector<std::string>{"a walk"});
    const Clip& back = file->clip();
    ASSERT_EQ(back.frames, clip.frames);
    // A whole rate is taken where all keys lie on it to a thousandth of a frame.
    EXPECT_NEAR(back.frame_time * clip.frames, clip.frame_time * clip.frames,
                clip.frame_time * 1e-3);
    ASSERT_EQ(back.joints(), clip.joints() + 1);
    EXPECT_EQ(back.skeleton.joints[0].name, "a walk");
    EXPECT_EQ(back.skeleton.joints[0].rest, kZUp);
    for (size_t j = 0; j < clip.joints(); ++j) {
      const Joint &in = clip.skeleton.joints[j], &out = back.skeleton.joints[j + 1];
      EXPECT_EQ(out.name, in.name);
      EXPECT_EQ(out.parent, in.parent + 1);
      for (int f = 0; f < clip.frames; ++f) {
        const Quat a = clip.pose(f).rotations[j], b = back.pose(f).rotations[j + 1];
        EXPECT_TRUE(a == b || a == (Quat{-b.x, -b.y, -b.z, -b.w}));
        // Times a hundredth, rounded once.
        const Vec3 position = in.can_translate ? clip.pose(f).translations[j] : in.offset;
        EXPECT_EQ(back.pose(f).translations[j + 1],
                  (position.as<double>() * kCentimetre).as<float>());
      }
    }
  }
}

TEST(GltfFormat, a_vrm_animation_reads_back_with_its_roles) {
  Clip clip = test::walking_clip(20);
  for (size_t j = 0; j < clip.joints(); ++j) {
    clip.skeleton.joints[j].role = human_joint_name(static_cast<int>(j));
  }
  const std::string bytes = format_vrma(clip, "a walk");
  auto file = parse_vrma(bytes, "walk.vrma");
  ASSERT_TRUE(file.ok()) << file.error().message;
  EXPECT_EQ((*file)->clip_names(), std::vector<std::string>{"a walk"});
  Clip back = (*file)->clip();
  ASSERT_EQ(back.joints(), clip.joints() + 1);
  for (size_t j = 0; j < clip.joints(); ++j) {
    EXPECT_EQ(back.skeleton.joints[j + 1].role, clip.skeleton.joints[j].role);
    EXPECT_EQ(back.skeleton.joints[j + 1].can_translate, j == 0);
    for (int f = 0; f < clip.frames; ++f) {
      const Quat a = clip.pose(f).rotations[j], b = back.pose(f).rotations[j + 1];
      EXPECT_TRUE(a == b || a == (Quat{-b.x, -b.y, -b.z, -b.w}));
      EXPECT_EQ(back.pose(f).translations[j + 1], clip.pose(f).translations[j]);
    }
  }
  // A player takes the first animation, so that an edit is always in its place.
  back.pose(3).rotations[5] = {0, 1, 0, 0};
  const std::vector<double> frames = same_frames(back.frames);
  const ClipEdit edits[] = {{0, &back, frames, "b"}};
  auto again = parse_vrma((*file)->encode(edits, EditMode::add_beside), "walk.vrma");
  ASSERT_TRUE(again.ok()) << again.error().message;
  EXPECT_EQ((*again)->clip_names(), std::vector<std::string>{"a walk"});
  EXPECT_EQ((*again)->clip().pose(3).rotations[5], (Quat{0, 1, 0, 0}));
}

TEST(GltfFormat, only_what_moves_is_animated) {
  const Clip clip = bvh_clip("plain.bvh");
  const GltfParts parts = test::glb_parts(format_glb(clip, "walk", 1, {}));
  size_t expected = 0;
  for (const Joint& joint : clip.skeleton.joints)
    expected += joint.can_rotate + joint.can_translate;
  EXPECT_EQ(parts.json["animations"][0]["channels"].size(), expected);
}

TEST(GltfFormat, end_sites_are_nodes_without_children) {
  const Clip clip = bvh_clip("plain.bvh");
  const GltfParts parts = test::glb_parts(format_glb(clip, "walk", 1, {}));
  size_t ends = 0;
  for (size_t j = 0; j < clip.joints(); ++j) {
    for (const Vec3 end : clip.skeleton.joints[j].ends) {
      const test::Json& node = parts.json["nodes"][1 + clip.joints() + ends++];
      EXPECT_EQ(node["name"], clip.skeleton.joints[j].name + " end");
      EXPECT_EQ(node["translation"][1], end.y);
      EXPECT_FALSE(node.contains("children"));
    }
  }
  EXPECT_GT(ends, 0u);
}

TEST(GltfFormat, a_body_is_one_mesh_on_the_joints_of_the_clip) {
  const Clip clip = test::walking_clip(2);
  const SkinnedBody body = make_rig_body(*Rig::create(clip), clip.pose(0));
  const GltfParts parts = test::glb_parts(format_glb(clip, "walk", 1, {}, &body));
  ASSERT_EQ(parts.json["meshes"].size(), 1u);
  const test::Json& primitive = parts.json["meshes"][0]["primitives"][0];
  const auto count = [&](const test::Json& accessor) {
    return parts.json["accessors"][accessor.get<size_t>()]["count"].get<size_t>();
  };
  EXPECT_EQ(count(primitive["indices"]), body.triangles.size());
  for (const char* what : {"POSITION", "NORMAL", "JOINTS_0", "WEIGHTS_0", "COLOR_0"}) {
    EXPECT_EQ(count(primitive["attributes"][what]), body.positions.size()) << what;
  }
  for (const test::Json& view : parts.json["bufferViews"]) {
    EXPECT_LT(view["buffer"].get<size_t>(), parts.json["buffers"].size());
  }
  const test::Json& joints = parts.json["skins"][0]["joints"];
  // All joints and ends; those that move the mesh come first.
  size_t all = clip.joints();
  for (const Joint& joint : clip.skeleton.joints) all += joint.ends.size();
  ASSERT_EQ(joints.size(), all);
  for (size_t b = 0; b < body.binds.size(); ++b) EXPECT_EQ(joints[b], body.binds[b].joint + 1);
}

TEST(GltfFormat, a_clip_with_nothing_to_see_is_written_too) {
  Clip clip;
  clip.skeleton.joints.resize(1);
  clip.skeleton.joints[0].name = "dot";
  clip.resize(1);
  clip.rotations[0] = {};
  clip.translations[0] = {};
  const auto file = must_read(format_glb(clip, "dot", 1, {}));
  EXPECT_TRUE(file->clip_names().empty());
  EXPECT_EQ(file->clip().joints(), 2u);
}

// Data inside of addresses.

TEST(GltfUri, data_may_be_base64_or_percent_encoded) {
  EXPECT_EQ(*decode_data_uri("data:;base64,AAEC/w=="), std::string("\0\1\2\xff", 4));
  EXPECT_EQ(*decode_data_uri("data:text/plain,a%4Ab%4ac%20"), "aJbJc ");
  EXPECT_EQ(*decode_data_uri("data:,%0a%Af%9A%fF"), "\x0a\xaf\x9a\xff");
  // A percent sign without two hexadecimal digits stays as it is.
  EXPECT_EQ(*decode_data_uri("data:,%zz%4"), "%zz%4");
  EXPECT_EQ(*decode_data_uri("data:,%4g%g4%"), "%4g%g4%");
  EXPECT_EQ(*decode_data_uri("data:,%/1%:1%@1%G1%`1"), "%/1%:1%@1%G1%`1");
  const auto no_comma = decode_data_uri("data:text/plain");
  ASSERT_FALSE(no_comma.ok());
  EXPECT_EQ(no_comma.error().message,
            "expected a data URI with a comma before its data, found none");
}

TEST(GltfUri, what_is_made_reads_back) {
  std::string bytes;
  for (int i = 0; i < 8; ++i) {
    EXPECT_EQ(*decode_data_uri(make_data_uri("image/png", bytes)), bytes);
    bytes += static_cast<char>(37 * i + 250);
  }
}

}  // namespace
}  // namespace panache
