#pragma once
// A take of a walk that is bent at the spine.

#include <string>

#include "learn/take.h"
#include "make_clip.h"
#include "rig/rig.h"

namespace panache::test {

inline constexpr float kBend = 0.4f;  // Radians, forward at the spine.

inline Take walk_take(const std::string& style, const std::string& content, int frames,
                      float bend) {
  Clip clip = walking_clip(frames);
  for (int f = 0; f < frames; ++f) {
    clip.pose(f).rotations[index(HumanJoint::spine)] = axis_angle(Vec3{1, 0, 0}, bend);
  }
  Take take = make_take(clip, *Rig::create(clip), PoseLayout::positions);
  take.row = {style + content, style, content, "001", style == "neutral", true, 0};
  return take;
}

}  // namespace panache::test
