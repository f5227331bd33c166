#include "vmc_filter.h"

#include <algorithm>
#include <string>
#include <utility>

#include "base/elementary.h"
#include "vmc_bones.h"

namespace panache::cli {
namespace {

// Two stages cut jitter more than one of the same delay. A stage delays a movement by its time
// constant or less, so each has half of it.
constexpr size_t kStages = 2;
constexpr double kLongestGap = 0.5;  // Seconds; after it the sender has begun anew.

// "RightHand" of "LeftHand"; the bone itself if it has no side.
std::string twin_name(std::string_view bone) {
  constexpr std::string_view kLeft = "Left", kRight = "Right";
  if (bone.starts_with(kLeft)) return std::string(kRight) + std::string(bone.substr(kLeft.size()));
  if (bone.starts_with(kRight)) return std::string(kLeft) + std::string(bone.substr(kRight.size()));
  return std::string(bone);
}

}  // namespace

VmcFilter::VmcFilter(std::span<const int> bones, bool mirror, double smooth)
    : mirrors_(mirror), smooth_(smooth) {
  for (size_t j = 0; j < bones.size(); ++j) {
    const std::string twin = twin_name(vmc_bone_name(bones[j]));
    const auto found = std::find_if(bones.begin(), bones.end(),
                                    [&](int bone) { return vmc_bone_name(bone) == twin; });
    twins_.push_back(found == bones.end() ? j : static_cast<size_t>(found - bones.begin()));
    moves_.push_back(bones[j] == kVmcRoot || bones[j] == kVmcHips);
  }
}

void VmcFilter::apply(Pose pose, double seconds) {
  if (mirrors_) mirror(pose);
  if (smooth_ > 0) smooth(pose, seconds);
}

void VmcFilter::mirror(Pose pose) {
  for (size_t j = 0; j < twins_.size(); ++j) {
    if (twins_[j] > j) std::swap(pose.rotations[j], pose.rotations[twins_[j]]);
  }
  // The mirror is the plane x = 0, and at rest all axes are those of the world.
  for (size_t j = 0; j < twins_.size(); ++j) {
    Quat& q = pose.rotations[j];
    q = {q.x, -q.y, -q.z, q.w};
    if (moves_[j]) pose.translations[j].x = -pose.translations[j].x;
  }
}

void VmcFilter::smooth(Pose pose, double seconds) {
  if (seconds > kLongestGap) reset();
  if (stages_.empty()) {
    stages_.assign(kStages, {{pose.rotations.begin(), pose.rotations.end()},
                             {pose.translations.begin(), pose.translations.end()}});
  }
  const float gain =
      filter_gain(static_cast<float>(seconds), static_cast<float>(smooth_ / double{kStages}));
  for (Stage& stage : stages_) {
    for (size_t j = 0; j < twins_.size(); ++j) {
      Quat& q = stage.rotations[j];
      Vec3& p = stage.translations[j];
      const Quat turned = nlerp(q, pose.rotations[j], gain);
      const Vec3 moved = p + (pose.translations[j] - p) * gain;
      // Numbers that are no pose pass unchanged, and are forgotten.
      if (!is_finite(turned) || !is_finite(moved)) continue;
      pose.rotations[j] = q = turned;
      pose.translations[j] = p = moved;
    }
  }
}

}  // namespace panache::cli
