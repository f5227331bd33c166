#pragma once
// One tree of the joints that deform a mesh, for files that have them in pieces.

#include <memory>
#include <optional>
#include <vector>

#include "clip/clip.h"
#include "clip/motion_file.h"

namespace panache {

// A position and a rotation in the space of the roots, file units.
struct Placed {
  Quat rotation;
  Vec3 position;
};

// The position and rotation of a child of `parent` with this local transform.
inline Placed below(const Placed& parent, Quat rotation, Vec3 translation) {
  return {normalized(parent.rotation * rotation),
          parent.position + rotate(parent.rotation, translation)};
}

// The position `to` in the axes of `from`.
inline Vec3 seen_from(const Placed& from, Vec3 to) {
  return rotate(conjugate(from.rotation), to - from.position);
}

// All joints in a pose, [joints].
inline std::vector<Placed> world_joints(const Skeleton& skeleton, ConstPose pose) {
  std::vector<Quat> rotations(skeleton.joints.size());
  std::vector<Vec3> positions(skeleton.joints.size());
  world_pose(skeleton, pose, {rotations, positions});
  std::vector<Placed> placed;
  placed.reserve(positions.size());
  for (size_t j = 0; j < positions.size(); ++j) placed.push_back({rotations[j], positions[j]});
  return placed;
}

struct DeformTree {
  std::vector<int> joints;   // Indices in the file, parents first.
  std::vector<int> parents;  // [joints]: index in `joints`, or -1.
};

// `clip`: a motion of the file or its rest pose, at least one frame; it shows what moves together.
// Nothing if the joints are connected already, or do not belong to a person.
std::optional<DeformTree> find_deform_tree(const Clip& clip);

// Control rigs (such as Rigify) move the joints that deform a mesh by constraints. Exporters bake
// those and leave the joints where they are in the rig's tree: legs and arms are children of its
// root or of controls, not of the spine. Moving such hips moves no leg. Here the same motion is on
// one tree of the deforming joints only, derived from what moves together; edits are written back
// to the file's own tree.
//
// Returns `file` itself if its deforming joints are connected. Otherwise a file whose clips have
// only the deforming joints of the character with the most vertices, in one tree and with the same
// positions in every frame. An edited frame equal to its source is written as in the file; joints
// that deform nothing follow their own parents as before.
std::unique_ptr<MotionFile> join_deforming_joints(std::unique_ptr<MotionFile> file);

}  // namespace panache
