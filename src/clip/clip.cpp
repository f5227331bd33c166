#include "clip/clip.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <vector>

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

bool leaves_rest_position(const Clip& clip, size_t joint) {
  constexpr float kStays = 1e-4f;  // Relative to its distance.
  const Vec3 offset = clip.skeleton.joints[joint].offset;
  for (int f = 0; f < clip.frames; ++f) {
    if (length(clip.pose(f).translations[joint] - offset) > kStays * length(offset)) return true;
  }
  return false;
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
      const float shift = length(pose.translations[j] - joint.offset);
      joint.still = turn <= kRounding && shift <= kRounding * size;
    }
  }
}

void sample(const Clip& clip, double frame, Pose out) {
  assert(clip.frames > 0);
  assert(out.rotations.size() == clip.joints() && out.translations.size() == clip.joints());
  const double last = clip.frames - 1;
  const double position = frame > 0 ? std::min(frame, last) : 0.0;  // NaN counts as 0.
  const int before = static_cast<int>(position);
  const float t = static_cast<float>(position - before);
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

// With W the world rotation of a joint at rest, W_p that of its parent, and R and R_p the same in a
// frame: the new local rotation is W_p q W^-1 and the new translation W_p t. By induction the new
// world rotation is R W^-1, the identity at rest, and a child's new offset from its parent, R_p
// W_p^-1 W_p t = R_p t, is the old one.
Clip in_rest_axes(const Clip& clip) {
  const std::vector<Joint>& old = clip.skeleton.joints;
  // A skeleton without rest rotations keeps its exact bits.
  if (std::all_of(old.begin(), old.end(), [](const Joint& j) { return j.rest == Quat{}; })) {
    return clip;
  }
  Clip out = clip;
  const size_t joints = clip.joints();
  std::vector<Quat> world(joints), parent(joints);  // W and W_p.
  for (size_t j = 0; j < joints; ++j) {
    Joint& joint = out.skeleton.joints[j];
    if (joint.parent >= 0) parent[j] = world[joint.parent];
    world[j] = normalized(parent[j] * joint.rest);
    joint.rest = {};
    joint.offset = rotate(parent[j], joint.offset);
    for (Vec3& end : joint.ends) end = rotate(world[j], end);
  }
  for (int i = 0; i < clip.frames; ++i) {
    const Pose pose = out.pose(i);
    for (size_t j = 0; j < joints; ++j) {
      pose.rotations[j] = normalized(parent[j] * pose.rotations[j] * conjugate(world[j]));
      pose.translations[j] = rotate(parent[j], pose.translations[j]);
    }
  }
  return out;
}

}  // namespace panache
