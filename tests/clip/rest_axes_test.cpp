#include "clip/clip.h"

#include <gtest/gtest.h>

#include "base/random.h"

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

}  // namespace
}  // namespace panache
