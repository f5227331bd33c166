#include "rig/sampled_joints.h"

#include <algorithm>

#include "clip/clip.h"

namespace panache {

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
