#pragma once
// The input of the last seconds, readable at any time within it.

#include <span>
#include <vector>

#include "clip/clip.h"
#include "pose/features.h"

namespace panache {

// Only the constructor allocates.
class InputRing {
 public:
  // Room for `seconds` of poses with that many joints, at any rate.
  InputRing(size_t joints, double seconds);

  void clear() noexcept { head_ = times_.size() - 1, count_ = 0; }
  // Adds a pose at `time` (seconds, never before the last one), with the body and root that the rig
  // read from it.
  void push(double time, ConstPose pose, const HumanPositions& body, const RootPose& root) noexcept;

  bool empty() const noexcept { return count_ == 0; }
  double oldest() const noexcept { return time(count_ - 1); }
  double newest() const noexcept { return time(0); }
  // The input at `time`, clamped to oldest() to newest(), linear between poses: joints, body (in
  // the body frame) and root. Nothing if empty.
  void pose(double time, Pose out) const noexcept;
  HumanPositions body(double time) const noexcept;
  RootPose root(double time) const noexcept;

  // Calls visit(member) for everything that tells one ring from another of its size.
  template <class Self, class Visit>
  static void visit_state(Self& self, Visit&& visit) {
    visit(self.head_), visit(self.count_), visit(self.times_, self.count_ * sizeof(double));
    visit(self.bodies_, self.count_ * sizeof(Body));
    visit(self.rotations_, self.count_ * self.joints_ * sizeof(Quat));
    visit(self.translations_, self.count_ * self.joints_ * sizeof(Vec3));
  }

 private:
  // A pose as the rig read it. Times are stored separately to avoid padding.
  struct Body {
    HumanPositions positions{};
    RootPose root;
  };
  struct Between {
    size_t a, b;  // Indices: earlier, later.
    float t;
  };
  // A pose closer than this to the one before is replaced by the next, so that any rate fits. All
  // poses of a 120 Hz tracker are kept.
  static constexpr double kMinGap = 0.008;

  size_t index_of(size_t age) const noexcept {
    return (head_ + times_.size() - age) % times_.size();
  }
  double time(size_t age) const noexcept { return times_[index_of(age)]; }
  Between find(double time) const noexcept;

  size_t joints_;
  std::vector<double> times_;
  std::vector<Body> bodies_;
  std::vector<Quat> rotations_;     // [entries][joints]
  std::vector<Vec3> translations_;  // Likewise.
  size_t head_, count_ = 0;         // `head_`: index of the newest; the first push has index 0.
};

}  // namespace panache
