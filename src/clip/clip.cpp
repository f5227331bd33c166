#include "clip/clip.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace panache {

ConstPose Clip::pose(int frame) const {
  assert(frame >= 0 && frame < frames);
  const size_t first = static_cast<size_t>(frame) * joints();
  return {{rotations.data() + first, joints()}, {translations.data() + first, joints()}};
}

Pose Clip::pose(int frame) {
  assert(frame >= 0 && frame < frames);
  const size_t first = static_cast<size_t>(frame) * joints();
  return {{rotations.data() + first, joints()}, {translations.data() + first, joints()}};
}

void Clip::resize(int count) {
  assert(count >= 0);
  const size_t size = static_cast<size_t>(count) * joints();
  rotations.resize(size);
  translations.resize(size);
  frames = count;
}

void Clip::append(ConstPose pose) {
  assert(pose.rotations.size() == joints() && pose.translations.size() == joints());
  rotations.insert(rotations.end(), pose.rotations.begin(), pose.rotations.end());
  translations.insert(translations.end(), pose.translations.begin(), pose.translations.end());
  ++frames;
}

Clip rest_clip(const Skeleton& skeleton) {
  Clip out{skeleton, 1.0 / 30, 1, {}, {}};
  for (const Joint& joint : skeleton.joints) {
    out.rotations.push_back(joint.rest);
    out.translations.push_back(joint.offset);
  }
  return out;
}

void world_pose(const Skeleton& skeleton, ConstPose local, Pose world) noexcept {
  const size_t joints = skeleton.joints.size();
  assert(local.rotations.size() == joints && local.translations.size() == joints);
  assert(world.rotations.size() == joints && world.translations.size() == joints);
  // Parents come before children.
  for (size_t j = 0; j < joints; ++j) {
    place_joint(static_cast<int>(j), skeleton.joints[j].parent, local, world);
  }
}

void mark_still_joints(Clip& clip) {
  // Programs write the rest pose into every frame, in floats that went through matrices. Less than
  // 1e-4 radians, or 1e-4 of the largest distance between two joints, is invisible.
  constexpr float kRounding = 1e-4f;
  float size = 0;
  for (const Joint& joint : clip.skeleton.joints) size = std::max(size, length(joint.offset));
  for (size_t j = 0; j < clip.joints(); ++j) {
    Joint& joint = clip.skeleton.joints[j];
    joint.still = true;
    for (int f = 0; f < clip.frames && joint.still; ++f) {
      const ConstPose pose = clip.pose(f);
      const float turn = 2 * length((conjugate(joint.rest) * pose.rotations[j]).xyz());
      const float way = length(pose.translations[j] - joint.offset);
      joint.still = turn <= kRounding && way <= kRounding * size;
    }
  }
}

void sample(const Clip& clip, double frame, Pose out) {
  assert(clip.frames > 0);
  assert(out.rotations.size() == clip.joints() && out.translations.size() == clip.joints());
  const double last = clip.frames - 1;
  const double place = frame > 0 ? std::min(frame, last) : 0.0;  // NaN counts as 0.
  const int before = static_cast<int>(place);
  const float t = static_cast<float>(place - before);
  const ConstPose a = clip.pose(before);
  if (t == 0) {
    std::copy(a.rotations.begin(), a.rotations.end(), out.rotations.begin());
    std::copy(a.translations.begin(), a.translations.end(), out.translations.begin());
    return;
  }
  const ConstPose b = clip.pose(std::min(before + 1, clip.frames - 1));
  for (size_t j = 0; j < clip.joints(); ++j) {
    // a (1 - t) + a t is not always a: a joint that holds still must not change by a last bit, or
    // it would lose the file's own numbers when written.
    out.rotations[j] = a.rotations[j] == b.rotations[j] ? a.rotations[j]
                                                        : nlerp(a.rotations[j], b.rotations[j], t);
    out.translations[j] = a.translations[j] == b.translations[j]
                              ? a.translations[j]
                              : lerp(a.translations[j], b.translations[j], t);
  }
}

}  // namespace panache
