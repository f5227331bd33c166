#pragma once
// The persons in a skeleton: files of scenes hold several, often with the same joint names.

#include <span>
#include <string>
#include <vector>

#include "clip/clip.h"
#include "rig/joint_subset.h"

namespace panache {

struct Figure {
  int root = 0;        // Its topmost joint that no other figure is below.
  std::string name;    // That joint's name, made unique.
  bool moves = false;  // Whether the clip moves one of its joints.
};

// The figures of a clip's skeleton, in the order of its joints; empty if it holds one at most.
// Bodies that go together throughout the clip, such as a person and its clothes, are one figure.
std::vector<Figure> find_figures(const Clip& clip);
// The same, with the skeleton in a few of the clip's poses.
std::vector<Figure> find_figures(const Clip& clip, std::span<const JointPositions> poses);

// The joints of the figure with that root, and those above it.
JointSubset figure_joints(const Skeleton& skeleton, int root);

}  // namespace panache
