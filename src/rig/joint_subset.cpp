#include "rig/joint_subset.h"

#include <algorithm>
#include <cstddef>
#include <string>

namespace panache {

JointSubset::JointSubset(const Skeleton& whole, std::span<const int> parents,
                         std::span<const char> taken) {
  const size_t count = whole.joints.size();
  std::vector<int> index(count, -1);
  const auto add = [&](size_t joint, int parent) {
    index[joint] = static_cast<int>(original.size());
    original.push_back(static_cast<int>(joint));
    skeleton.joints.push_back(whole.joints[joint]);
    skeleton.joints.back().parent = parent;
  };
  const auto above = [&](size_t joint) {
    int up = parents[joint];
    while (up >= 0 && !taken[up]) up = parents[up];
    return up;
  };
  // Parents first; each round adds at least the joints whose parents are there.
  for (bool more = true; more;) {
    more = false;
    for (size_t j = 0; j < count; ++j) {
      if (!taken[j] || index[j] >= 0) continue;
      const int parent = above(j);
      if (parent >= 0 && index[parent] < 0) continue;
      add(j, parent < 0 ? -1 : index[parent]);
      more = true;
    }
  }
}

bool JointSubset::has(int joint) const {
  return std::find(original.begin(), original.end(), joint) != original.end();
}

std::vector<JointPositions> JointSubset::poses_of(std::span<const JointPositions> whole) const {
  std::vector<JointPositions> out;
  for (const JointPositions& pose : whole) {
    out.emplace_back();
    for (const int joint : original) out.back().push_back(pose[joint]);
  }
  return out;
}

Result<Mapping> JointSubset::map(std::span<const JointPositions> whole,
                                 const KnownJoints& known) const {
  KnownJoints inside;
  for (const auto& [human, joint] : known) {
    int found = -1;
    for (size_t i = 0; i < original.size(); ++i) {
      if (original[i] == joint) found = static_cast<int>(i);
    }
    if (joint >= 0 && found < 0) {
      return Error{std::string(human_joint_name(human)) +
                   ": expected a joint of the figure that is mapped, found one of another"};
    }
    inside[human] = found;
  }
  Result<Mapping> mapping = map_humanoid(skeleton, poses_of(whole), inside);
  if (!mapping) return mapping;
  for (int& joint : mapping->joint_of) joint = joint < 0 ? -1 : original[joint];
  return mapping;
}

}  // namespace panache
