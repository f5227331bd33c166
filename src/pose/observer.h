#pragma once
// Takes in one character's input: sanitises poses, converts them to the canonical body and to the
// body frame, and detects cuts.

#include <span>
#include <vector>

#include "pose/features.h"
#include "rig/posed_rig.h"

namespace panache {

// One instant of a character.
struct Observation {
  BodyPose world;               // In the world.
  RootPose root;                // Its position and heading.
  HumanPositions body_frame{};  // Its canonical joints relative to `root`, metres.
};

// Reads `pose` with `rig`; the facing is the one nearest to `last_facing`.
void observe(PosedRig& rig, ConstPose pose, float last_facing, Observation& out) noexcept;

// Only the constructor allocates; nothing fails.
class Observer {
 public:
  // A pose after a longer gap does not continue the motion. Seconds.
  static constexpr double kMaxGap = 0.5;
  // A pose that implies a higher speed over the ground does not continue it either. The default,
  // m/s: sprinters reach 12; bodies on vehicles are faster.
  static constexpr float kMaxGroundSpeed = 15;

  // `max_speed`: m/s, positive; infinity: no limit.
  explicit Observer(Rig rig, float max_speed = kMaxGroundSpeed);

  // Forgets the motion so far.
  void reset() noexcept { started_ = false; }

  // Takes in the pose `seconds` after the last. Invalid rotations and translations are replaced by
  // the last valid ones. Returns whether it continues the motion; false at the first pose, too.
  bool observe(ConstPose in, double seconds) noexcept;

  // The pose as taken in: all values are finite.
  ConstPose pose() const noexcept { return {rotations_, translations_}; }
  const Observation& now() const noexcept { return now_; }
  // Position and heading at the pose before; the origin at the first.
  const RootPose& last_root() const noexcept { return last_root_; }
  const Rig& rig() const noexcept { return rig_.rig(); }

  // The pose as taken in with `change`, see PosedRig::write().
  void write(const BodyChange& change, Pose out) noexcept {
    rig_.write(pose(), now_.world, change, out);
  }

  // Adds the arrays that observe() and write() use.
  void add_memory(Prefetch& prefetch) const noexcept;

  // Calls visit(member) for everything that tells one character from another of this rig.
  template <class Self, class Visit>
  static void visit_state(Self& self, Visit&& visit) {
    PosedRig::visit_state(self.rig_, visit);
    visit(self.rotations_), visit(self.translations_), visit(self.now_), visit(self.last_root_);
    visit(self.started_);
  }

 private:
  void sanitize_pose(ConstPose in) noexcept;

  float max_speed_;
  PosedRig rig_;
  std::vector<Quat> rotations_;     // [joints]
  std::vector<Vec3> translations_;  // [joints]
  Observation now_;
  RootPose last_root_;
  bool started_ = false;
};

}  // namespace panache
