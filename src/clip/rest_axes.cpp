#include "clip/rest_axes.h"

#include <algorithm>
#include <vector>

namespace panache {

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
