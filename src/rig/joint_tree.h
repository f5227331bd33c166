#pragma once
// Questions about the tree of a skeleton and about how far its joints are apart. Private to the
// folder.

#include <span>
#include <vector>

#include "clip/clip.h"

namespace panache {

// Where the joints of a skeleton are, [joints], in any axes and units.
using JointPositions = std::vector<Vec3>;

class JointTree {
 public:
  // poses: the skeleton in a few poses, at least one. Both outlive the tree.
  JointTree(const Skeleton& skeleton, std::span<const JointPositions> poses);

  int count() const { return static_cast<int>(skeleton_.joints.size()); }
  std::span<const JointPositions> poses() const { return poses_; }
  int parent(int joint) const { return skeleton_.joints[joint].parent; }
  const std::vector<int>& children(int joint) const { return children_[joint]; }
  // Whether `above` is `joint` or one of its ancestors.
  bool is_above(int above, int joint) const;
  int depth(int joint) const;  // 1 for a root.
  // Whether vertices of a mesh follow the joint, as far as the file says.
  bool moves_mesh(int joint) const { return skeleton_.joints[joint].skin >= 0; }
  // How many of the joint and what is above it have more than one child.
  int forks(int joint) const { return joint < 0 ? 0 : forks_[joint]; }
  // The lowest joint that is above both; -1 where they have no tree in common, or one is -1.
  int meeting(int a, int b) const;

  // Mean over the poses, file units.
  float distance(int a, int b) const;
  // Whether they stand further apart than half a percent of the body.
  bool apart(int a, int b) const { return distance(a, b) >= nearness_; }
  // From the joint to the farthest of its End Sites, file units; 0 where it has none.
  float end_length(int joint) const;
  // The longest way from the joint down to a leaf or End Site, along the joints, file units.
  float reach(int joint) const { return reach_[joint]; }

 private:
  const Skeleton& skeleton_;
  std::span<const JointPositions> poses_;
  std::vector<std::vector<int>> children_;
  std::vector<float> reach_;
  std::vector<int> forks_;
  float nearness_ = 0;
};

}  // namespace panache
