#pragma once
// Motion files and a manifest made by a formula: a neutral walk, and one that leans forward.

#include <string>

#include <gtest/gtest.h>

#include "base/file.h"
#include "clip/bvh.h"
#include "make_clip.h"

namespace panache::test {

inline constexpr float kLean = 0.4f;  // Radians, at the spine.

// Writes neutral.bvh, old.bvh and manifest.csv into `folder`, which ends in '/'. `splits`: the
// splits that each take is listed in.
inline void write_manifest(const std::string& folder,
                           const std::vector<std::string>& splits = {"train"}) {
  const Clip neutral = walking_clip(150);
  Clip styled = walking_clip(120);
  for (int f = 0; f < styled.frames; ++f) {
    styled.pose(f).rotations[index(HumanJoint::spine)] = axis_angle(Vec3{1, 0, 0}, kLean);
  }
  std::string rows = "path,style,content,take,neutral,split\n";
  for (const std::string& split : splits) {
    rows += "neutral.bvh,normal,walk,001,1," + split + "\nold.bvh,old,walk,001,0," + split + "\n";
  }
  ASSERT_TRUE(write_file(folder + "neutral.bvh", format_bvh(neutral), true).ok());
  ASSERT_TRUE(write_file(folder + "old.bvh", format_bvh(styled), true).ok());
  ASSERT_TRUE(write_file(folder + "manifest.csv", rows, true).ok());
}

}  // namespace panache::test
