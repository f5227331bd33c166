#pragma once
// The tree of the joints that deform a mesh, where a file has them in pieces. Private to the
// folder.

#include <optional>
#include <vector>

#include "clip/clip.h"

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

struct DeformTree {
  std::vector<int> joints;   // Of the file, parents first.
  std::vector<int> parents;  // [joints]: place in `joints`, or -1.
};

// clip: a motion of the file or its rest pose, one frame at least; what moves together is seen in
// it. Nothing where the joints hang together as they are, or where they are no person's.
std::optional<DeformTree> find_deform_tree(const Clip& clip);

}  // namespace panache
