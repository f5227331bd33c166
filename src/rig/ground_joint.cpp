#include "rig/ground_joint.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "rig/sampled_joints.h"

namespace panache {
namespace {

constexpr int kGroundPoses = 100;
// The path must be at least so long, in canonical metres, and the hips may stray from the joint by
// this share of it.
constexpr float kShortestPath = 0.3f, kStraysOff = 0.4f;

}  // namespace

int find_ground_joint(const Clip& clip, int hips, const Calibration& calibration) {
  const std::vector<Joint>& joints = clip.skeleton.joints;
  for (int joint = joints[hips].parent; joint >= 0; joint = joints[joint].parent) {
    if (!joints[joint].can_translate) continue;
    const int of[] = {joint, hips};
    const int step = std::max(1, clip.frames / kGroundPoses);
    const SampledJoints frames(clip, calibration.first_frame, clip.frames, step, of);
    if (frames.count() < 2) return -1;
    const auto on_ground = [&](int frame, int which) {
      Vec3 p = rotate(calibration.y_up, frames.world(frame).translations[which]);
      p.y = 0;
      return p * calibration.scale;
    };
    float path = 0, strays = 0;
    const Vec3 start = on_ground(0, 0), start_apart = on_ground(0, 1) - start;
    for (int f = 1; f < frames.count(); ++f) {
      const Vec3 here = on_ground(f, 0);
      path = std::max(path, length(here - start));
      strays = std::max(strays, length(on_ground(f, 1) - here - start_apart));
    }
    if (path > kShortestPath && strays < kStraysOff * path) return joint;
  }
  return -1;
}

}  // namespace panache
