#include "rig/body_motions.h"

#include <algorithm>
#include <vector>

#include "rig/file_space.h"

namespace panache {
namespace {

// The position of a joint and the rotation of its parent, from the joints above.
struct Placed {
  Quatd above, turn;
  Vec3d position;
};

// The hips and the joints above them, from the top.
std::vector<size_t> chain_to_hips(const Rig& rig, const Clip& clip) {
  std::vector<size_t> chain;
  for (int j = rig.joints()[index(HumanJoint::hips)]; j >= 0;) {
    chain.push_back(static_cast<size_t>(j));
    j = clip.skeleton.joints[chain.back()].parent;
  }
  std::reverse(chain.begin(), chain.end());
  return chain;
}

Placed below(const Placed& parent, ConstPose pose, size_t joint) {
  const Quatd turn = parent.turn * pose.rotations[joint].as<double>();
  return {parent.turn, turn,
          parent.position + rotate(parent.turn, pose.translations[joint].as<double>())};
}

}  // namespace

void stay_in_place(const Rig& rig, Clip& clip) {
  const std::vector<size_t> chain = chain_to_hips(rig, clip);
  const Quatd to_y_up = turn_up(rig.up_axis()).value_or(Quat{}).as<double>();
  const Vec3d up = rotate(conjugate(to_y_up), Vec3d{0, 1, 0});
  const int first = std::min(rig.first_frame(), clip.frames - 1);
  std::vector<Vec3d> starts;
  for (int f = first; f < clip.frames; ++f) {
    const Pose pose = clip.pose(f);
    Placed parent{};
    for (size_t i = 0; i < chain.size(); ++i) {
      const size_t j = chain[i];
      Placed placed = below(parent, pose, j);
      if (f == first) starts.push_back(placed.position);
      Vec3d path = placed.position - starts[i];
      path = path - up * dot(path, up);
      if (clip.skeleton.joints[j].can_translate && !(path == Vec3d{})) {
        const Vec3d local = rotate(conjugate(placed.above), path);
        pose.translations[j] = (pose.translations[j].as<double>() - local).as<float>();
        placed = below(parent, pose, j);
      }
      parent = placed;
    }
  }
}

}  // namespace panache
