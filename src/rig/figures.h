#pragma once
// The persons in a skeleton: files of scenes hold several, often with the same joint names. Each
// is some of its joints, as a skeleton of its own for the mapping.

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/quat.h"
#include "base/result.h"
#include "clip/clip.h"
#include "rig/joint_tree.h"
#include "rig/mapping.h"

namespace panache {

// parents[joints]: each joint's parent in the subset, of any index, without cycles; joints for
// which `taken` is 0 are left out, and their children hang on the nearest joint above that is not.
struct JointSubset {
  JointSubset(const Skeleton& skeleton, std::span<const int> parents, std::span<const char> taken);

  bool has(int joint) const;  // An index in the whole skeleton.
  // The same joints of whole poses.
  std::vector<JointPositions> poses_of(std::span<const JointPositions> whole) const;
  // map_humanoid() for the subset, in indices of the whole skeleton. Joints that are `known`
  // outside the subset are rejected.
  Result<Mapping> map(std::span<const JointPositions> whole, const KnownJoints& known) const;

  Skeleton skeleton;
  std::vector<int> original;  // [joints of the subset]: index in the whole skeleton.
};

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

// The space of a motion file: its up axis and its unit.

struct UsualUnit {
  std::string_view name;  // "metres", "CMU units", ...
  double metres;
};

// The likely unit for a scale inferred from the length of the legs (metres per file unit, for
// canonical legs); nothing if none is close.
std::optional<UsualUnit> usual_unit(double metres);

// The rotation that turns `axis` ("+X", "-Z", ...) to +y; nothing if the name is invalid.
std::optional<Quat> turn_up(std::string_view axis);

}  // namespace panache
