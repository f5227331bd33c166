#include "pose/observer.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace panache {

void observe(PosedRig& rig, ConstPose pose, float last_facing, Observation& out) noexcept {
  rig.read(pose, out.world);
  out.root = root_pose_of(out.world, last_facing);
  to_body_frame(out.world.positions, out.root, out.body_frame);
}

Observer::Observer(Rig rig, float max_speed)
    : max_speed_(max_speed),
      rig_(std::move(rig)),
      rotations_(rig_.rig().joint_count()),
      translations_(rig_.rig().joint_count()) {}

bool Observer::observe(ConstPose in, double seconds) noexcept {
  if (seconds > kMaxGap) reset();
  sanitize_pose(in);
  last_root_ = started_ ? now_.root : RootPose{};
  panache::observe(rig_, pose(), started_ ? last_root_.facing : 0, now_);
  const float max = max_speed_ * static_cast<float>(std::max(seconds, 1e-3));
  const bool continues = started_ && !(length(now_.root.position - last_root_.position) > max);
  started_ = true;
  return continues;
}

void Observer::add_memory(Prefetch& prefetch) const noexcept {
  prefetch.add(std::span(rotations_));
  prefetch.add(std::span(translations_));
  rig_.add_memory(prefetch);
}

// Also rejects numbers so large that products overflow.
void Observer::sanitize_pose(ConstPose in) noexcept {
  constexpr float kFar = 1e9f;
  assert(in.rotations.size() == rotations_.size());
  for (size_t j = 0; j < rotations_.size(); ++j) {
    const Quat q = in.rotations[j];
    const Vec3 t = in.translations[j];
    // Also false for non-finite values.
    if (std::abs(dot(q, q) - 1) < 0.1f) rotations_[j] = q;
    if (std::abs(t.x) < kFar && std::abs(t.y) < kFar && std::abs(t.z) < kFar) translations_[j] = t;
  }
}

}  // namespace panache
