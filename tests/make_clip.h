#pragma once
// Something like a walk on the canonical skeleton, for tests that need a motion and no particular
// one.

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

#include "clip/clip.h"
#include "rig/canonical_body.h"
#include "rig/humanoid.h"

namespace panache::test {

// `frames` frames of walking along +z at 1.2 m/s, arms hanging, one stride a second.
inline Clip walking_clip(int frames, double fps = 30) {
  using enum HumanJoint;
  constexpr float kSpeed = 1.2f, kThigh = 0.45f, kArm = 0.4f;
  constexpr Vec3 x = {1, 0, 0}, z = {0, 0, 1};
  Clip clip;
  clip.skeleton = canonical_skeleton();
  clip.frame_time = 1 / fps;
  clip.resize(frames);
  for (int f = 0; f < frames; ++f) {
    const float seconds = static_cast<float>(f * clip.frame_time);
    const float phase = 2 * 3.14159265f * seconds;
    const Pose pose = clip.pose(f);
    for (size_t j = 0; j < clip.joints(); ++j) {
      pose.rotations[j] = {};
      pose.translations[j] = clip.skeleton.joints[j].offset;
    }
    pose.translations[0].z += kSpeed * seconds;
    const auto turn = [&](HumanJoint joint, Quat q) {
      pose.rotations[static_cast<size_t>(index(joint))] = q;
    };
    // Down from the T-pose, then swung against the leg of the same side.
    const float swing = std::sin(phase);
    turn(left_upper_arm, axis_angle(x, kArm * swing) * axis_angle(z, -1.4f));
    turn(right_upper_arm, axis_angle(x, -kArm * swing) * axis_angle(z, 1.4f));
    turn(left_upper_leg, axis_angle(x, -kThigh * swing));
    turn(right_upper_leg, axis_angle(x, kThigh * swing));
    turn(left_lower_leg, axis_angle(x, 0.1f + 0.7f * std::max(0.0f, std::cos(phase))));
    turn(right_lower_leg, axis_angle(x, 0.1f + 0.7f * std::max(0.0f, -std::cos(phase))));
  }
  return clip;
}

// Where the joints are in the world, [joints].
inline std::vector<Vec3> world_positions(const Clip& clip, int frame) {
  std::vector<Quat> rotations(clip.joints());
  std::vector<Vec3> positions(clip.joints());
  world_pose(clip.skeleton, clip.pose(frame), {rotations, positions});
  return positions;
}

// Whether all poses are the same to the bit.
inline bool same_bits(const Clip& a, const Clip& b) {
  const auto same = [](const auto& p, const auto& q) {
    return p.size() == q.size() && std::memcmp(p.data(), q.data(), p.size() * sizeof p[0]) == 0;
  };
  return same(a.rotations, b.rotations) && same(a.translations, b.translations);
}

}  // namespace panache::test
