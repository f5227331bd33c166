#pragma once
// Converts poses between one character's skeleton and the canonical body, and to what draws a
// posed rig as a figure: position and full orientation, including twist, per human joint,
// independent of the rig's local axes.

#include <array>
#include <span>
#include <vector>

#include "base/prefetch.h"
#include "rig/humanoid.h"
#include "rig/rig.h"

namespace panache {

// A rig and the last pose read from one character. The constructor allocates; read() and write()
// neither allocate nor fail.
class PosedRig {
 public:
  // ground_joint: the joint above the hips that write() moves along the ground, -1 for the hips
  // themselves.
  PosedRig(Rig rig, int ground_joint);
  explicit PosedRig(const Rig& rig) : PosedRig(rig, rig.ground_joint()) {}

  const Rig& rig() const noexcept { return rig_; }

  // Reads the user's pose as one of the canonical body. A pose without a heading keeps the last
  // one. A pose that is not finite is replaced by the last finite one; returns whether it was
  // finite.
  bool read(ConstPose pose, BodyPose& out) noexcept;
  // The same with all rotations, which stay unchanged if the pose is not finite.
  bool read(ConstPose pose, RotatedBodyPose& out) noexcept;

  // A joint's rotation in the last pose, see RotatedBodyPose; not finite if the pose is not.
  Quat world_rotation(int human_joint) const noexcept;

  // Writes the user's pose with `change`. `in` and `body` are those of the last read(), whose
  // forward kinematics it reuses. If the change is the identity, `out` is identical to `in`. Joints
  // outside the humanoid, or without rotation channels, keep their local rotation and follow their
  // parent or the joint of the body that they go with. The middle between the upper legs turns in
  // place and moves by the translation, if the hips or a joint above them can. `in` and `out` may
  // be the same arrays.
  void write(ConstPose in, const BodyPose& body, const BodyChange& change, Pose out) noexcept;

  // Adds the arrays that read() and write() use.
  void add_memory(Prefetch& prefetch) const noexcept;

  // Calls visit(member) for the memory from one read() to the next.
  template <class Self, class Visit>
  static void visit_state(Self& self, Visit&& visit) {
    visit(self.last_);
  }

 private:
  // The rotations that write() applies to the human joints, file axes.
  using Deltas = std::array<Quat, kHumanJoints>;

  // The delta that a joint of the skeleton has or inherits; -1: the world.
  Quat delta_of(const Deltas& deltas, int joint) const noexcept;
  void write_rotations(ConstPose in, const Deltas& deltas, Pose out) noexcept;
  void write_translation(ConstPose in, const Deltas& deltas, const BodyChange& change,
                         Pose out) noexcept;
  void write_followers(const Deltas& deltas, Pose out) noexcept;

  Rig rig_;
  int ground_joint_;
  BodyPose last_;  // The last finite one.

  // [joints], of the last read(), file axes and units; only those that matter, see
  // Rig::Shared::placed.
  std::vector<Quat> world_rotations_;
  std::vector<Vec3> world_translations_;
  // The same of the last write(); empty if no joint follows another.
  std::vector<Quat> new_rotations_;
  std::vector<Vec3> new_translations_;
};

// Per human joint a world position (metres, Y up) and a world rotation x y z w.
inline constexpr int kPartNumbers = 7;
inline constexpr int kMannequinNumbers = kHumanJoints * kPartNumbers;

class Mannequin {
 public:
  // `reference`: a pose of `rig` without twists; upright, facing ahead.
  Mannequin(const Rig& rig, ConstPose reference);

  // The parts of a pose. In the frame of its joint, a part lies as in the canonical T-pose: the
  // left arm along +x, the legs along -y, the feet ahead along +z. Allocates nothing.
  void read(ConstPose pose, std::span<float, kMannequinNumbers> out) noexcept;
  // Each joint's position in the frame of its parent, metres; zero if the rig lacks it. For the
  // hips, their height above the floor.
  const HumanPositions& offsets() const { return offsets_; }
  // From the axes of each human joint's part to the raw local axes of the rig's joint.
  const std::array<Quat, kHumanJoints>& to_part() const { return to_part_; }

 private:
  PosedRig rig_;
  RotatedBodyPose body_;
  std::array<Quat, kHumanJoints> to_part_;  // From the rig's local axes to those of the part.
  HumanPositions offsets_;
};

}  // namespace panache
