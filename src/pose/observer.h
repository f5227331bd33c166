#pragma once
// One character's input as it comes: poses are made sound, brought to the canonical body and seen
// in the body frame, and cuts are detected.

#include <span>
#include <vector>

#include "pose/root_pose.h"
#include "rig/posed_rig.h"

namespace panache {

// One instant of a character.
struct Observation {
  BodyPose world;               // In the world.
  RootPose root;                // Where it stands and looks.
  HumanPositions body_frame{};  // Its canonical joints seen from there, metres.
};

// Reads `pose` with `rig`; the facing is the one nearest to `last_facing`.
void observe(PosedRig& rig, ConstPose pose, float last_facing, Observation& out) noexcept;

// The constructor allocates; nothing else does, and nothing fails.
class Observer {
 public:
  // A pose that comes after a longer gap does not continue what was before. Seconds.
  static constexpr double kMaxGap = 0.5;
  // A pose that implies a faster way over the ground does not continue it either. The default, m/s:
  // a sprinter reaches 12; bodies on vehicles are faster.
  static constexpr float kMaxGroundSpeed = 15;

  // `max_speed`: m/s, more than 0; with infinity no way is too far.
  explicit Observer(Rig rig, float max_speed = kMaxGroundSpeed);

  // Forgets the motion so far.
  void reset() noexcept { started_ = false; }

  // Takes in the pose `seconds` after the last. Invalid rotations and translations are replaced by
  // the last valid ones. Returns whether it continues the motion; false at the first pose, too.
  bool observe(ConstPose in, double seconds) noexcept;

  // The pose as taken in: every number of it is finite.
  ConstPose pose() const noexcept { return {rotations_, translations_}; }
  const Observation& now() const noexcept { return now_; }
  // Where the body stood and looked at the pose before; the origin at the first.
  const RootPose& last_root() const noexcept { return last_root_; }
  const Rig& rig() const noexcept { return rig_.rig(); }

  // The pose as taken in with `change` on it, see PosedRig::write().
  void write(const BodyChange& change, Pose out) noexcept {
    rig_.write(pose(), now_.world, change, out);
  }

  // Names the arrays that observe() and write() work on.
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
