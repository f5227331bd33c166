#pragma once
// Euler angles in any order of distinct axes, and back from rotations without flips.

#include <array>

#include "base/quat.h"

namespace panache {

// One to three distinct axes (0 x, 1 y, 2 z); R = R(axis[0]) R(axis[1]) R(axis[2]).
struct EulerOrder {
  int count = 0;
  std::array<int, 3> axis = {0, 0, 0};
};
using EulerAngles = std::array<double, 3>;  // Degrees, in the order of the axes.

// The rotation by `angles`; the identity where the order has no axes.
Quatd euler_to_quat(const EulerOrder& order, const EulerAngles& angles);

// The angles of `rotation` nearest to `near` (degrees): of both solutions, and of all multiples of
// 360, those with the smallest sum of squared differences. An angle that gimbal lock leaves
// undetermined stays as in `near`. With fewer than three axes, the nearest rotation about them.
// Unused angles are 0.
EulerAngles quat_to_euler(const EulerOrder& order, Quatd rotation, const EulerAngles& near);

}  // namespace panache
