#pragma once
// The effect of node scales on joint positions, in a skeleton whose joints only rotate and
// move. Private to the folder.
//
// The world transform of a node has the linear part L = W B: W is the product of the rotations of
// the node and of all above it, which is the rotation of the clip's joint, and B is the stretch: a
// child at `t` in the file is at B t from the joint, in the joint's axes. Below a parent with W',
// B' a node that rotates by C and stretches by U has W = W' C and B = C^-1 B' C U, because L = L' C
// U. A uniform B' (one number times the identity) does not depend on C; others change with the
// pose.
//
// A mirror image is not a rotation, but its negative is: a scale with the signs s contains the half
// turn d diag(s), where d is the product of the signs, and what remains is d |scale|. So B is
// uniform for every scale whose axes differ only in sign, and W does not depend on which of several
// equivalent scales and rotations a file uses.

#include <array>

#include "base/quat.h"
#include "base/vec.h"

namespace panache {

class Stretch {
 public:
  Stretch() = default;
  // The identity times `size`, which may be negative.
  explicit Stretch(double size) : size_(size) {}
  // The matrix with these columns; uniform if it is a number times the identity to within 1e-4.
  explicit Stretch(const std::array<Vec3d, 3>& columns);

  // Lengths of the columns.
  std::array<double, 3> lengths() const;
  // Whether the stretch can be inverted.
  bool can_undo() const;

  Vec3d apply(Vec3d position) const;
  Vec3 apply(Vec3 position) const { return apply(position.as<double>()).as<float>(); }
  // The position that apply() maps to `stretched`; requires can_undo().
  Vec3d undo(Vec3d stretched) const;
  Vec3 undo(Vec3 stretched) const { return undo(stretched.as<double>()).as<float>(); }

  // The stretch of a node below, which rotates by `turn` and stretches by `own`.
  Stretch below(Quat turn, const Stretch& own) const;

  friend bool operator==(const Stretch&, const Stretch&) = default;

 private:
  Vec3d times(Vec3d v) const { return columns_[0] * v.x + columns_[1] * v.y + columns_[2] * v.z; }
  double determinant() const { return dot(cross(columns_[0], columns_[1]), columns_[2]); }

  bool even_ = true;
  double size_ = 1;                 // If uniform.
  std::array<Vec3d, 3> columns_{};  // If not.
};

// A scale of three numbers, decomposed.
struct NodeScale {
  Quat turn;        // The identity or half a turn; after the node's rotation.
  Stretch stretch;  // In the axes after that turn.
};
// If all three scales are 0, they count as 1.
NodeScale split_scale(Vec3d scale);

// The linear part of a matrix, as a rotation applied after a stretch.
struct SplitMatrix {
  Quat rotation;
  Stretch stretch;
};
SplitMatrix split_matrix(const std::array<Vec3d, 3>& columns);

}  // namespace panache
