#pragma once
// The data to draw a posed rig as a figure: position and full orientation, including twist, per
// human joint, independent of the rig's local axes.

#include <array>
#include <span>

#include "rig/posed_rig.h"

namespace panache {

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
