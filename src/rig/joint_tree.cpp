#include "rig/joint_tree.h"

#include <algorithm>

#include "clip/clip.h"

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

SampledJoints::SampledJoints(const Clip& clip, int first, int end, int step,
                             std::span<const int> of)
    : joints_(of.size()) {
  std::vector<Quat> rotations(clip.joints());
  std::vector<Vec3> translations(clip.joints());
  for (int f = first; f < end; f += step) {
    world_pose(clip.skeleton, clip.pose(f), {rotations, translations});
    if (!std::all_of(of.begin(), of.end(),
                     [&](int j) { return j < 0 || is_finite(translations[j]); })) {
      continue;
    }
    for (int j : of) {
      rotations_.push_back(j < 0 ? Quat{} : rotations[j]);
      translations_.push_back(j < 0 ? Vec3{} : translations[j]);
    }
    ++count_;
  }
}

std::vector<std::vector<Vec3>> some_poses(const Clip& clip) {
  constexpr int kMax = 15;
  Clip world = rest_clip(clip.skeleton);
  std::vector<std::vector<Vec3>> poses;
  const auto add = [&](ConstPose pose) {
    world_pose(clip.skeleton, pose, world.pose(0));
    const std::vector<Vec3>& positions = world.translations;
    if (std::all_of(positions.begin(), positions.end(), [](Vec3 p) { return is_finite(p); }))
      poses.push_back(positions);
  };
  add(world.pose(0));
  const int count = std::min(kMax, clip.frames);
  for (int i = 0; i < count; ++i) add(clip.pose((2 * i + 1) * clip.frames / (2 * count)));
  return poses;
}

float quantile(std::vector<float> values, float share) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  const float at = share * static_cast<float>(values.size() - 1);
  const size_t low = static_cast<size_t>(at);
  const size_t high = std::min(low + 1, values.size() - 1);
  return values[low] + (values[high] - values[low]) * (at - static_cast<float>(low));
}

}  // namespace panache
