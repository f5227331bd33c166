#pragma once
// The effect of node scales on joint positions, in a skeleton whose joints only rotate and
// move. Private to the folder.
//
// The world transform of a node has the linear part L = W B: W is the product of the rotations of
// the node and of all above it, which is what a joint of a clip turns by, and B is the stretch,
// with which a child at `t` in the file stands at B t from the joint, in the joint's axes. Below a
// parent with W', B' a node that turns by C and stretches by U has W = W' C and B = C^-1 B' C U, by
// L = L' C U. An even B' (one number times the identity) is the same whatever C is; the others turn
// with the pose.
//
// A mirror image is no rotation, but its opposite is: a scale with the signs s has the half turn
// d diag(s) in it, where d is the product of the signs, and what remains is d |scale|. So B is even
// for every scale whose axes differ in their signs only, and W does not depend on which of several
// scales and rotations say the same.

#include <array>

#include "base/quat.h"
#include "base/vec.h"

namespace panache {

class Stretch {
 public:
  Stretch() = default;
  // The identity times `size`, which may be negative.
  explicit Stretch(double size) : size_(size) {}
  // The matrix with these columns; even where it is the identity times a number to 1e-4.
  explicit Stretch(const std::array<Vec3d, 3>& columns);

  // Lengths of the columns.
  std::array<double, 3> lengths() const;
  // Whether the stretch can be inverted.
  bool can_undo() const;

  Vec3 apply(Vec3 place) const;
  // The place that apply() brings to `stretched`; can_undo().
  Vec3 undo(Vec3 stretched) const;

  // That of a node below, which turns by `turn` and stretches by `own`.
  Stretch below(Quat turn, const Stretch& own) const;

  friend bool operator==(const Stretch&, const Stretch&) = default;

 private:
  Vec3d times(Vec3d v) const { return columns_[0] * v.x + columns_[1] * v.y + columns_[2] * v.z; }
  double determinant() const { return dot(cross(columns_[0], columns_[1]), columns_[2]); }

  bool even_ = true;
  double size_ = 1;                 // Where even.
  std::array<Vec3d, 3> columns_{};  // Where not.
};

// A scale of three numbers, taken apart.
struct NodeScale {
  Quat turn;        // The identity or half a turn; after the node's rotation.
  Stretch stretch;  // Along the axes that these give.
};
// What is scaled away entirely has no size to get wrong: three zeros are three ones.
NodeScale split_scale(Vec3d scale);

// The linear part of a matrix as a rotation and what comes before it.
struct SplitMatrix {
  Quat rotation;
  Stretch stretch;
};
SplitMatrix split_matrix(const std::array<Vec3d, 3>& columns);

}  // namespace panache
