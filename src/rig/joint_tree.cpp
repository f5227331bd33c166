#include "rig/joint_tree.h"

#include <algorithm>

namespace panache {

JointTree::JointTree(const Skeleton& skeleton, std::span<const JointPositions> poses)
    : skeleton_(skeleton), poses_(poses), children_(count()), reach_(count()) {
  float size = 0;
  for (const JointPositions& pose : poses) {
    Vec3 low = pose.empty() ? Vec3{} : pose[0], high = low;
    for (const Vec3& p : pose) {
      low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    size += length(high - low) / static_cast<float>(poses.size());
  }
  nearness_ = 0.005f * size;
  // Children come after their parents.
  for (int j = count() - 1; j >= 0; --j) {
    reach_[j] = std::max(reach_[j], end_length(j));
    const int above = parent(j);
    if (above >= 0) reach_[above] = std::max(reach_[above], distance(above, j) + reach_[j]);
  }
  for (int j = 0; j < count(); ++j) {
    if (parent(j) >= 0) children_[parent(j)].push_back(j);
  }
  for (int j = 0; j < count(); ++j) {
    forks_.push_back(forks(parent(j)) + (children(j).size() > 1 ? 1 : 0));
  }
}

bool JointTree::is_above(int above, int joint) const {
  while (joint > above) joint = parent(joint);
  return joint == above && joint >= 0;
}

int JointTree::depth(int joint) const {
  int n = 0;
  while (joint >= 0) joint = parent(joint), ++n;
  return n;
}

int JointTree::meeting(int a, int b) const {
  while (a != b && a >= 0 && b >= 0) (a > b ? a : b) = parent(a > b ? a : b);
  return a == b ? a : -1;
}

float JointTree::distance(int a, int b) const {
  float sum = 0;
  for (const JointPositions& pose : poses_) sum += length(pose[a] - pose[b]);
  return sum / static_cast<float>(poses_.size());
}

float JointTree::end_length(int joint) const {
  float longest = 0;
  for (const Vec3& end : skeleton_.joints[joint].ends) longest = std::max(longest, length(end));
  return longest;
}

}  // namespace panache
