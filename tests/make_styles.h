#pragma once
// Motion of styles and actions that nobody could confuse, made by a formula: two actions (a walk,
// and waving while standing) in three styles (neutral, bent forward, leant back).

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "base/file.h"
#include "clip/bvh.h"
#include "make_clip.h"

namespace panache::test {

inline constexpr const char* kContents[] = {"walk", "wave"};
// How far the spine bends forward, radians.
inline float bend_of(const std::string& style) {
  return style == "old" ? 0.5f : style == "proud" ? -0.4f : 0.0f;
}

// Turns a walk into waving with the right hand while standing.
inline void stand_and_wave(Clip& clip) {
  using enum HumanJoint;
  for (int f = 0; f < clip.frames; ++f) {
    const Pose pose = clip.pose(f);
    pose.translations[0].z = 0;
    const auto turn = [&](HumanJoint joint, Quat q) {
      pose.rotations[static_cast<size_t>(index(joint))] = q;
    };
    for (const HumanJoint leg :
         {left_upper_leg, right_upper_leg, left_lower_leg, right_lower_leg}) {
      turn(leg, {});
    }
    const float phase = 2 * 3.14159265f * static_cast<float>(f * clip.frame_time);
    turn(left_upper_arm, axis_angle(Vec3{0, 0, 1}, -1.4f));
    turn(right_upper_arm, axis_angle(Vec3{0, 0, 1}, -0.9f));
    turn(right_lower_arm, axis_angle(Vec3{0, 0, 1}, -0.5f + 0.6f * std::sin(phase)));
  }
}

// `take` sets where in the action it begins and how far it bends: takes of different numbers are
// never the same.
inline Clip styled_clip(const std::string& style, const std::string& content, int take,
                        int frames = 90) {
  const int skipped = 7 * take;
  Clip whole = walking_clip(frames + skipped);
  if (content == "wave") stand_and_wave(whole);
  Clip clip;
  clip.skeleton = whole.skeleton;
  clip.frame_time = whole.frame_time;
  clip.resize(frames);
  const float lean = bend_of(style) * (1 + 0.05f * static_cast<float>(take % 3));
  for (int f = 0; f < frames; ++f) {
    const Pose pose = clip.pose(f);
    std::copy_n(whole.pose(f + skipped).rotations.begin(), clip.joints(), pose.rotations.begin());
    std::copy_n(whole.pose(f + skipped).translations.begin(), clip.joints(),
                pose.translations.begin());
    pose.rotations[static_cast<size_t>(index(HumanJoint::spine))] = axis_angle(Vec3{1, 0, 0}, lean);
  }
  return clip;
}

// Writes every style and content as files, takes 0 to `training` - 1 of each to learn from and the
// two after that held out, and the manifest takes.csv, into `folder`, which ends in '/'.
inline void write_styles(const std::string& folder, const std::vector<std::string>& styles,
                         int training, int frames = 90) {
  std::string rows = "path,style,content,take,neutral,split\n";
  for (const std::string& style : styles) {
    for (const std::string content : kContents) {
      for (int n = 0; n < training + 2; ++n) {
        const std::string number = std::to_string(n), name = style + "-" + content + "-" + number;
        const std::string bvh = format_bvh(styled_clip(style, content, n, frames));
        ASSERT_TRUE(write_file(folder + name + ".bvh", bvh, true).ok());
        rows += name + ".bvh," + style + "," + content + "," + number + "," +
                (style == "neutral" ? "1," : "0,") + (n < training ? "train\n" : "test\n");
      }
    }
  }
  ASSERT_TRUE(write_file(folder + "takes.csv", rows, true).ok());
}

}  // namespace panache::test
