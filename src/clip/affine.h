#pragma once
// Maps that keep lines straight. Private to the folder.

#include <array>
#include <cmath>

#include "base/quat.h"
#include "base/vec.h"

namespace panache {

// An affine map: the matrix of a node, or an inverse bind matrix.
struct Affine {
  std::array<Vec3d, 3> columns = {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}};
  Vec3d origin = {};  // Where the origin goes.

  Vec3d turn(Vec3d v) const { return columns[0] * v.x + columns[1] * v.y + columns[2] * v.z; }
  Vec3d apply(Vec3d v) const { return turn(v) + origin; }
  friend Affine operator*(const Affine& a, const Affine& b) {  // b first.
    return {{a.turn(b.columns[0]), a.turn(b.columns[1]), a.turn(b.columns[2])}, a.apply(b.origin)};
  }
};

// Rotates, then translates.
inline Affine affine(Quatd rotation, Vec3d origin, Vec3d scale = {1, 1, 1}) {
  return {{rotate(rotation, Vec3d{scale.x, 0, 0}), rotate(rotation, Vec3d{0, scale.y, 0}),
           rotate(rotation, Vec3d{0, 0, scale.z})},
          origin};
}

// Returns the identity if `m` has no inverse.
inline Affine inverse(const Affine& m) {
  const auto& [x, y, z] = m.columns;
  const double determinant = dot(cross(x, y), z);
  if (!(std::abs(determinant) > 1e-30)) return {};
  const Vec3d rows[3] = {cross(y, z) / determinant, cross(z, x) / determinant,
                         cross(x, y) / determinant};
  Affine out;
  out.columns = {Vec3d{rows[0].x, rows[1].x, rows[2].x}, Vec3d{rows[0].y, rows[1].y, rows[2].y},
                 Vec3d{rows[0].z, rows[1].z, rows[2].z}};
  out.origin = -out.turn(m.origin);
  return out;
}

}  // namespace panache
