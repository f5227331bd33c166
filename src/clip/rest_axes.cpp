#include "clip/rest_axes.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace panache {

// With W the world rotation of a joint at rest, W_p that of its parent, and R and R_p the same in a
// frame: the new local rotation is W_p q W^-1 and the new translation W_p t. By induction the new
// world rotation is R W^-1, the identity at rest, and a child's new place R_p W_p^-1 W_p t = R_p t
// from its parent is the old one.
Clip in_rest_axes(const Clip& clip) {
  const std::vector<Joint>& old = clip.skeleton.joints;
  // What is right already keeps its last bits.
  if (std::all_of(old.begin(), old.end(), [](const Joint& j) { return j.rest == Quat{}; })) {
    return clip;
  }
  Clip out = clip;
  const size_t joints = clip.joints();
  std::vector<Quat> world(joints), parent(joints);  // W and W_p.
  for (size_t j = 0; j < joints; ++j) {
    Joint& joint = out.skeleton.joints[j];
    if (joint.parent >= 0) parent[j] = world[static_cast<size_t>(joint.parent)];
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

Clip without_still_root(Clip clip) {
  const std::vector<Joint>& joints = clip.skeleton.joints;
  const auto children_of = [&](int parent) {
    return std::count_if(joints.begin(), joints.end(),
                         [&](const Joint& j) { return j.parent == parent; });
  };
  const auto is_still = [](const Joint& j) {
    return !j.can_rotate && !j.can_translate && j.skin < 0 && j.ends.empty() && j.role.empty();
  };
  while (joints.size() > 1 && children_of(-1) == 1 && children_of(0) == 1 &&
         is_still(joints.front())) {
    const Joint root = joints.front();
    Clip out{clip.skeleton, clip.frame_time, 0, {}, {}};
    out.skeleton.joints.erase(out.skeleton.joints.begin());
    for (Joint& joint : out.skeleton.joints) --joint.parent;
    Joint& child = out.skeleton.joints.front();
    child.offset = root.offset + rotate(root.rest, child.offset);
    child.rest = root.rest * child.rest;
    for (int i = 0; i < clip.frames; ++i) {
      const Pose pose = clip.pose(i);
      pose.translations[1] = pose.translations[0] + rotate(pose.rotations[0], pose.translations[1]);
      pose.rotations[1] = pose.rotations[0] * pose.rotations[1];
      out.append({pose.rotations.subspan(1), pose.translations.subspan(1)});
    }
    clip = std::move(out);
  }
  return clip;
}

}  // namespace panache
