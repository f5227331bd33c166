#pragma once
// Where the joints of a skeleton are in a pose, for files whose joints hang on other parents than
// they follow. Private to the folder.

#include <cstddef>
#include <vector>

#include "clip/fk.h"

namespace panache {

// A place and a rotation in the space that the roots are in, file units.
struct Placed {
  Quat rotation;
  Vec3 position;
};

// What turns and stands so as seen from `parent`.
inline Placed below(const Placed& parent, Quat rotation, Vec3 translation) {
  return {normalized(parent.rotation * rotation),
          parent.position + rotate(parent.rotation, translation)};
}

// The place of `to` as seen from `from`.
inline Vec3 seen_from(const Placed& from, Vec3 to) {
  return rotate(conjugate(from.rotation), to - from.position);
}

// All joints in a pose, [joints].
inline std::vector<Placed> place(const Skeleton& skeleton, ConstPose pose) {
  std::vector<Quat> rotations(skeleton.joints.size());
  std::vector<Vec3> positions(skeleton.joints.size());
  world_pose(skeleton, pose, {rotations, positions});
  std::vector<Placed> placed;
  placed.reserve(positions.size());
  for (size_t j = 0; j < positions.size(); ++j) placed.push_back({rotations[j], positions[j]});
  return placed;
}

}  // namespace panache
