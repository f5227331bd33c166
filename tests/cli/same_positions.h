#pragma once
// Whether two files show the same motion, whatever their joints' axes are.

#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "clip/clip.h"
#include "clip/motion_file.h"

namespace panache::test {

// The world's places of all joints of `a` that `b` has too, by their names, frame by frame; `scale`
// turns the units of `b` into those of `a`.
inline void expect_same_positions(const Clip& a, const Clip& b, float tolerance, float scale = 1) {
  ASSERT_EQ(a.frames, b.frames);
  // BVH has its frame time to nine digits.
  EXPECT_NEAR(a.frame_time, b.frame_time, 1e-8);
  std::vector<Quat> rotations(std::max(a.joints(), b.joints()));
  std::vector<Vec3> in_a(a.joints()), in_b(b.joints());
  for (int f = 0; f < a.frames; ++f) {
    world_pose(a.skeleton, a.pose(f), {std::span(rotations).first(a.joints()), in_a});
    world_pose(b.skeleton, b.pose(f), {std::span(rotations).first(b.joints()), in_b});
    for (size_t i = 0; i < a.joints(); ++i) {
      const std::string& name = a.skeleton.joints[i].name;
      const auto same = std::find_if(b.skeleton.joints.begin(), b.skeleton.joints.end(),
                                     [&](const Joint& joint) { return joint.name == name; });
      ASSERT_NE(same, b.skeleton.joints.end()) << name;
      const auto j = static_cast<size_t>(same - b.skeleton.joints.begin());
      ASSERT_LE(length(in_a[i] - in_b[j] * scale), tolerance) << name << " in frame " << f;
    }
  }
}

}  // namespace panache::test
