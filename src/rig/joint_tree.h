#pragma once
// Queries on the hierarchy of a skeleton and on distances between its joints. Private to the
// folder.

#include <span>
#include <vector>

#include "clip/clip.h"

namespace panache {

// Positions of the joints of a skeleton, [joints], in any axes and units.
using JointPositions = std::vector<Vec3>;

class JointTree {
 public:
  // poses: the skeleton in a few poses, at least one. Both must outlive the tree.
  JointTree(const Skeleton& skeleton, std::span<const JointPositions> poses);

  int count() const { return static_cast<int>(skeleton_.joints.size()); }
  std::span<const JointPositions> poses() const { return poses_; }
  int parent(int joint) const { return skeleton_.joints[joint].parent; }
  const std::vector<int>& children(int joint) const { return children_[joint]; }
  // Whether `above` is `joint` or one of its ancestors.
  bool is_above(int above, int joint) const;
  int depth(int joint) const;  // 1 for a root.
  // Whether the file skins vertices of a mesh to the joint.
  bool moves_mesh(int joint) const { return skeleton_.joints[joint].skin >= 0; }
  // How many joints from the root to this one have more than one child.
  int forks(int joint) const { return joint < 0 ? 0 : forks_[joint]; }
  // The lowest common ancestor; -1 if there is none, or if one is -1.
  int meeting(int a, int b) const;

  // Mean over the poses, file units.
  float distance(int a, int b) const;
  // Whether their distance is more than half a percent of the body.
  bool apart(int a, int b) const { return distance(a, b) >= nearness_; }
  // From the joint to its farthest End Site, file units; 0 if it has none.
  float end_length(int joint) const;
  // The longest path from the joint down to a leaf or End Site, along the joints, file units.
  float reach(int joint) const { return reach_[joint]; }

 private:
  const Skeleton& skeleton_;
  std::span<const JointPositions> poses_;
  std::vector<std::vector<int>> children_;
  std::vector<float> reach_;
  std::vector<int> forks_;
  float nearness_ = 0;
};

// Samples poses of a clip, and computes quantiles. Private to the folder.

// Some joints in some frames of the clip, in world space, file axes and units.
class SampledJoints {
 public:
  // Samples the joints `of` (-1: none) in every `step`-th frame of [first, end). Skips frames in
  // which one of them is not finite.
  SampledJoints(const Clip& clip, int first, int end, int step, std::span<const int> of);

  int count() const { return count_; }
  ConstPose world(int i) const {
    const size_t at = static_cast<size_t>(i) * joints_;
    return {std::span(rotations_).subspan(at, joints_),
            std::span(translations_).subspan(at, joints_)};
  }

 private:
  size_t joints_;
  int count_ = 0;
  std::vector<Quat> rotations_;
  std::vector<Vec3> translations_;
};

// The finite ones of the rest pose and a few poses of the motion: positions in world space, file
// axes and units.
std::vector<std::vector<Vec3>> some_poses(const Clip& clip);

// The `share` quantile of the values, linear between neighbours; 0 if there are none.
float quantile(std::vector<float> values, float share);

}  // namespace panache
