#include "clip/fk.h"

#include <cassert>

namespace panache {

void world_pose(const Skeleton& skeleton, ConstPose local, Pose world) noexcept {
  const size_t joints = skeleton.joints.size();
  assert(local.rotations.size() == joints && local.translations.size() == joints);
  assert(world.rotations.size() == joints && world.translations.size() == joints);
  for (size_t j = 0; j < joints; ++j) {
    const int parent = skeleton.joints[j].parent;
    if (parent < 0) {
      world.rotations[j] = local.rotations[j];
      world.translations[j] = local.translations[j];
      continue;
    }
    // Parents come before children, so the parent's place in `world` is already the world's.
    const size_t p = static_cast<size_t>(parent);
    world.translations[j] =
        world.translations[p] + rotate(world.rotations[p], local.translations[j]);
    // Rounding shortens or lengthens a product a little; over a deep chain that would add up.
    world.rotations[j] = normalized(world.rotations[p] * local.rotations[j]);
  }
}

}  // namespace panache
