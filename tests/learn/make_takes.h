#pragma once
// Takes made by a formula: a "walk" in a neutral and in a styled way whose correspondence is known.

#include <cmath>
#include <string>
#include <vector>

#include "base/random.h"
#include "learn/take.h"
#include "make_clip.h"
#include "pose/features.h"
#include "rig/rig.h"

namespace panache::test {

// A body whose joints swing with `phase` and, styled, lean by `lean` radians at the chest.
inline void add_frame(Take& take, float phase, float lean) {
  HumanPositions body;
  std::array<Quat, kHumanJoints> turned;
  for (int j = 0; j < kHumanJoints; ++j) {
    const float share = static_cast<float>(j) / kHumanJoints;
    body[j] = {0.2f * std::sin(phase + share), 0.5f + share, 0.3f * std::cos(phase + 2 * share)};
    if (j == 2) body[j].z += lean;
    turned[j] = axis_angle(Vec3{1, 0, 0}, 0.3f * std::sin(phase + share) + (j == 2 ? lean : 0));
  }
  body[0] = {0, 0.9f + 0.02f * std::sin(2 * phase), 0};
  take.body.push_back(body);
  take.rotations.push_back(turned);
  take.root.push_back({{0, 0, static_cast<float>(take.frames()) / 30}, 0});
  take.contacts.push_back({std::sin(phase) > 0, std::sin(phase) <= 0});
}

// `rate`: neutral seconds per second of this take.
inline Take make_take(const std::string& style, int frames, float start, float rate, float lean,
                      PoseLayout layout = PoseLayout::positions) {
  Take take;
  take.row = {style + std::to_string(start), style, "walk", "001", style == "neutral", false, 0};
  for (int f = 0; f < frames; ++f) {
    add_frame(take, start + rate * 0.2f * static_cast<float>(f), lean);
  }
  write_numbers(layout, take);
  return take;
}

inline constexpr float kBend = 0.4f;  // Radians, forward at the spine.

// A walk that is bent at the spine.
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
