#include "style/play/input_ring.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace panache {

InputRing::InputRing(size_t joints, double seconds)
    : joints_(joints),
      times_(static_cast<size_t>(std::ceil(seconds / kMinGap)) + 3),
      bodies_(times_.size()),
      rotations_(times_.size() * joints),
      translations_(rotations_.size()),
      head_(times_.size() - 1) {}

void InputRing::push(double time, ConstPose pose, const HumanPositions& body,
                     const RootPose& root) noexcept {
  assert(pose.rotations.size() == joints_);
  const bool replaces =
      count_ > 0 && (time <= newest() || (count_ > 1 && this->time(0) - this->time(1) < kMinGap));
  if (!replaces) {
    head_ = (head_ + 1) % times_.size();
    count_ = std::min(count_ + 1, times_.size());
  }
  times_[head_] = time;
  bodies_[head_] = {body, root};
  std::copy(pose.rotations.begin(), pose.rotations.end(), &rotations_[head_ * joints_]);
  std::copy(pose.translations.begin(), pose.translations.end(), &translations_[head_ * joints_]);
}

InputRing::Between InputRing::find(double time) const noexcept {
  // The youngest entry that is no younger than `time`: binary search, as ages go back in time.
  size_t young = 0, old = count_ - 1;
  while (young < old) {
    const size_t middle = (young + old) / 2;
    if (this->time(middle) <= time) {
      old = middle;
    } else {
      young = middle + 1;
    }
  }
  const size_t a = index_of(old);
  if (old == 0 || times_[a] > time) return {a, a, 0};
  const size_t b = index_of(old - 1);
  const double gap = times_[b] - times_[a];
  return {a, b, static_cast<float>(std::min((time - times_[a]) / gap, 1.0))};
}

void InputRing::pose(double time, Pose out) const noexcept {
  if (empty()) return;
  const auto [a, b, t] = find(time);
  for (size_t j = 0; j < joints_; ++j) {
    const Quat &from = rotations_[a * joints_ + j], &to = rotations_[b * joints_ + j];
    // Exact at the poses themselves.
    out.rotations[j] = t == 0 ? from : nlerp(from, to, t);
    const Vec3 &here = translations_[a * joints_ + j], &there = translations_[b * joints_ + j];
    out.translations[j] = t == 0 ? here : lerp(here, there, t);
  }
}

HumanPositions InputRing::body(double time) const noexcept {
  HumanPositions out{};
  if (empty()) return out;
  const auto [a, b, t] = find(time);
  for (size_t j = 0; j < out.size(); ++j) {
    out[j] = lerp(bodies_[a].positions[j], bodies_[b].positions[j], t);
  }
  return out;
}

RootPose InputRing::root(double time) const noexcept {
  if (empty()) return {};
  const auto [a, b, t] = find(time);
  return interpolate(bodies_[a].root, bodies_[b].root, t);
}

}  // namespace panache
