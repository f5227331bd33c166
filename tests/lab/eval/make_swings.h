#pragma once
// Walks whose arms swing as far and as often as one likes: changes that are no mean posture.

#include <string>

#include "eval/test_input.h"
#include "learn/take.h"
#include "make_clip.h"
#include "rig/rig.h"

namespace panache::test {

// A walk, its left arm swung by `swing` radians `rate` times a second, bent by `bend` at the spine.
inline Clip swinging_clip(int frames, float swing, float rate = 1, float bend = 0) {
  Clip clip = walking_clip(frames);
  for (int f = 0; f < frames; ++f) {
    const float phase = 2 * 3.14159265f * rate * static_cast<float>(f) / 30;
    const Pose pose = clip.pose(f);
    pose.rotations[index(HumanJoint::left_upper_arm)] =
        axis_angle(Vec3{1, 0, 0}, swing * std::sin(phase)) * axis_angle(Vec3{0, 0, 1}, -1.4f);
    pose.rotations[index(HumanJoint::spine)] = axis_angle(Vec3{1, 0, 0}, bend);
  }
  return clip;
}

inline Take swinging_take(const std::string& style, int frames, float swing, float rate = 1,
                          float bend = 0) {
  const Clip clip = swinging_clip(frames, swing, rate, bend);
  Take take = make_take(clip, *Rig::create(clip), PoseLayout::positions);
  take.row = {style, style, "walk", "001", style == "neutral", false, 0};
  return take;
}

inline TestInput swinging_input(int frames, float swing, float rate = 1) {
  Clip clip = swinging_clip(frames, swing, rate);
  Rig rig = *Rig::create(clip);
  Take take = make_take(clip, rig, PoseLayout::positions);
  take.row = {"input", "neutral", "walk", "001", true, true, 0};
  return {std::move(clip), std::move(rig), std::move(take)};
}

}  // namespace panache::test
