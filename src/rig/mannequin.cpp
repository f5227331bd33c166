#include "rig/mannequin.h"

#include <algorithm>

#include "rig/canonical_skeleton.h"

namespace panache {

Mannequin::Mannequin(const Rig& rig, ConstPose reference) : rig_(rig) {
  rig_.read(reference, body_);
  std::array<Quat, kHumanJoints> parts;
  canonical_frames(body_.positions, body_.facing, parts);
  // A head's direction is only known from its rotation: assume that it is upright.
  parts[index(HumanJoint::head)] = rotation_y(body_.facing);
  for (int j = 0; j < kHumanJoints; ++j) {
    to_part_[j] = conjugate(body_.rotations[j]) * parts[j];
    const int parent = kHumanParent[j];
    offsets_[j] = parent < 0
                      ? Vec3{0, body_.joints[j].y, 0}
                      : rotate(conjugate(parts[parent]), body_.joints[j] - body_.joints[parent]);
  }
}

void Mannequin::read(ConstPose pose, std::span<float, kMannequinNumbers> out) noexcept {
  rig_.read(pose, body_);
  for (int j = 0; j < kHumanJoints; ++j) {
    const Vec3 p = body_.joints[j];
    const Quat q = body_.rotations[j] * to_part_[j];
    const float numbers[kPartNumbers] = {p.x, p.y, p.z, q.x, q.y, q.z, q.w};
    std::copy_n(numbers, kPartNumbers, out.begin() + kPartNumbers * j);
  }
}

}  // namespace panache
