#include "clip/rest_axes.h"

#include <gtest/gtest.h>

#include "base/random.h"
#include "clip/fk.h"

namespace panache {
namespace {

Quat some_rotation(Random& random) {
  const auto number = [&] { return static_cast<float>(random.normal()); };
  return normalized(Quat{number(), number(), number(), number()});
}

// A chain with a branch, every joint turned at rest, in three frames.
Clip turned_clip(bool turned) {
  Random random(1);
  Clip clip;
  for (int j = 0; j < 5; ++j) {
    Joint joint;
    joint.name = "joint" + std::to_string(j);
    joint.parent = j == 4 ? 1 : j - 1;
    joint.offset = {0.1f * static_cast<float>(j), 0.5f, -0.2f};
    if (turned) joint.rest = some_rotation(random);
    joint.ends = {{0, 0.3f, 0.1f}};
    clip.skeleton.joints.push_back(joint);
  }
  clip.resize(3);
  for (Quat& q : clip.rotations) q = some_rotation(random);
  for (size_t i = 0; i < clip.translations.size(); ++i) {
    clip.translations[i] = {0.2f, 0.4f, 0.1f * static_cast<float>(i)};
  }
  return clip;
}

// Five joints of half a metre, a few roundings of 2^-24 each.
constexpr float kNear = 2e-6f;

void expect_same_positions(const Clip& a, const Clip& b) {
  std::vector<Quat> turns_a(a.joints()), turns_b(b.joints());
  std::vector<Vec3> places_a(a.joints()), places_b(b.joints());
  for (int f = 0; f < a.frames; ++f) {
    world_pose(a.skeleton, a.pose(f), {turns_a, places_a});
    world_pose(b.skeleton, b.pose(f), {turns_b, places_b});
    for (size_t j = 0; j < a.joints(); ++j) {
      EXPECT_LE(length(places_a[j] - places_b[j]), kNear) << j;
      const Vec3 end_a = places_a[j] + rotate(turns_a[j], a.skeleton.joints[j].ends[0]);
      const Vec3 end_b = places_b[j] + rotate(turns_b[j], b.skeleton.joints[j].ends[0]);
      EXPECT_LE(length(end_a - end_b), kNear) << "end of " << j;
    }
  }
}

Clip at_rest(const Clip& clip) {
  Clip rest;
  rest.skeleton = clip.skeleton;
  rest.resize(1);
  for (size_t j = 0; j < rest.joints(); ++j) {
    rest.rotations[j] = rest.skeleton.joints[j].rest;
    rest.translations[j] = rest.skeleton.joints[j].offset;
  }
  return rest;
}

TEST(RestAxes, a_motion_keeps_every_place_and_rests_without_rotation) {
  const Clip clip = turned_clip(true), out = in_rest_axes(clip);
  for (const Joint& joint : out.skeleton.joints) EXPECT_EQ(joint.rest, Quat{});
  expect_same_positions(clip, out);
  expect_same_positions(at_rest(clip), at_rest(out));
}

TEST(RestAxes, a_motion_that_rests_without_rotation_stays_as_it_is) {
  const Clip clip = turned_clip(false), out = in_rest_axes(clip);
  EXPECT_EQ(clip.rotations, out.rotations);
  EXPECT_EQ(clip.translations, out.translations);
}

// The clip in a node that turns and lifts all of it.
Clip in_a_scene_node(const Clip& clip) {
  Joint node;
  node.name = "scene";
  node.rest = normalized(Quat{1, -1, 0, 0});
  node.offset = {0, 0.25f, 1};
  Clip out{{{node}}, clip.frame_time, 0, {}, {}};
  for (Joint joint : clip.skeleton.joints) {
    ++joint.parent;
    out.skeleton.joints.push_back(joint);
  }
  for (int f = 0; f < clip.frames; ++f) {
    const ConstPose pose = clip.pose(f);
    std::vector<Quat> rotations = {node.rest};
    std::vector<Vec3> translations = {node.offset};
    rotations.insert(rotations.end(), pose.rotations.begin(), pose.rotations.end());
    translations.insert(translations.end(), pose.translations.begin(), pose.translations.end());
    out.append({rotations, translations});
  }
  return out;
}

TEST(WithoutStillRoot, the_child_becomes_the_root_and_no_joint_moves) {
  const Clip clip = turned_clip(true), scene = in_a_scene_node(clip);
  const Clip out = without_still_root(scene);
  ASSERT_EQ(out.joints(), clip.joints());
  EXPECT_EQ(out.skeleton.joints.front().name, "joint0");
  EXPECT_EQ(out.skeleton.joints.front().parent, -1);
  for (const bool rest : {false, true}) {
    const Clip a = rest ? at_rest(scene) : scene, b = rest ? at_rest(out) : out;
    for (int f = 0; f < a.frames; ++f) {
      std::vector<Quat> turns_a(a.joints()), turns_b(b.joints());
      std::vector<Vec3> places_a(a.joints()), places_b(b.joints());
      world_pose(a.skeleton, a.pose(f), {turns_a, places_a});
      world_pose(b.skeleton, b.pose(f), {turns_b, places_b});
      for (size_t j = 0; j < b.joints(); ++j) {
        EXPECT_LE(length(places_a[j + 1] - places_b[j]), kNear) << j;
      }
    }
  }
}

TEST(WithoutStillRoot, a_root_stays_that_moves_or_carries_something) {
  const Clip scene = in_a_scene_node(turned_clip(true));
  const auto joints_left = [&](const auto& change) {
    Clip clip = scene;
    change(clip.skeleton.joints);
    return without_still_root(std::move(clip)).joints();
  };
  using Joints = std::vector<Joint>;
  EXPECT_EQ(joints_left([](Joints&) {}), 5u);
  EXPECT_EQ(joints_left([](Joints& j) { j[0].can_rotate = true; }), 6u);
  EXPECT_EQ(joints_left([](Joints& j) { j[0].can_translate = true; }), 6u);
  EXPECT_EQ(joints_left([](Joints& j) { j[0].skin = 0; }), 6u);
  EXPECT_EQ(joints_left([](Joints& j) { j[0].role = "hips"; }), 6u);
  EXPECT_EQ(joints_left([](Joints& j) { j[0].ends = {{0, 1, 0}}; }), 6u);
  EXPECT_EQ(joints_left([](Joints& j) { j[2].parent = 0; }), 6u);
}

}  // namespace
}  // namespace panache
