#pragma once
// The data to draw a posed rig as a figure: a place and a full orientation per human
// joint, twist included, whatever the local axes of the rig are.

#include <array>
#include <span>

#include "rig/posed_rig.h"

namespace panache {

// Per human joint a world position (metres, Y up) and a world rotation x y z w.
inline constexpr int kPartNumbers = 7;
inline constexpr int kMannequinNumbers = kHumanJoints * kPartNumbers;

class Mannequin {
 public:
  // `reference`: a pose of `rig` in which nothing is twisted; upright, looking ahead.
  Mannequin(const Rig& rig, ConstPose reference);

  // The parts of a pose. In the frame of its joint, a part lies as in the canonical T-pose: the
  // left arm along +x, the legs along -y, the feet ahead along +z. Allocates nothing.
  void read(ConstPose pose, std::span<float, kMannequinNumbers> out) noexcept;
  // Where each joint is in the frame of its parent, metres; zero where the rig has none. The hips
  // have their height above the floor instead.
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
