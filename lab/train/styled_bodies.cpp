#include "train/styled_bodies.h"

#include "train/statistics_guide.h"

namespace panache {
namespace {

constexpr int kBones = kHumanJoints - 1;

// 1 if a bone is on the path from the hips to a joint. [21][20]
const torch::Tensor& bones_above() {
  static const torch::Tensor above = [] {
    torch::Tensor matrix = torch::zeros({kHumanJoints, kBones});
    for (int j = 1; j < kHumanJoints; ++j) {
      for (int bone = j; bone > 0; bone = kHumanParent[bone]) matrix[j][bone - 1] = 1;
    }
    return matrix;
  }();
  return above;
}

// Rotates vectors by rotation vectors (Rodrigues). [...][3]
torch::Tensor rotated(const torch::Tensor& rotation, const torch::Tensor& vector) {
  const torch::Tensor square = rotation.square().sum(-1, true) + 1e-8;
  const torch::Tensor angle = square.sqrt();
  const torch::Tensor once = torch::linalg_cross(rotation, vector);
  const torch::Tensor twice = torch::linalg_cross(rotation, once);
  return vector + angle.sin() / angle * once + (1 - angle.cos()) / square * twice;
}

}  // namespace

torch::Tensor styled_bodies(const torch::Tensor& bodies, const torch::Tensor& changes) {
  // A change rotates the bones below a joint, and lifts the hips.
  const int64_t rows = bodies.size(0);
  const torch::Tensor bones = bodies.slice(1, 1) - bodies.index_select(1, bone_parents());
  const torch::Tensor rotations = changes.slice(1, 0, kHipsHeight)
                                      .reshape({rows, kHumanJoints, 3})
                                      .index_select(1, bone_parents());
  const torch::Tensor nothing = torch::zeros({rows, 1});
  const torch::Tensor lift =
      torch::cat({nothing, changes.slice(1, kHipsHeight, kHipsHeight + 1), nothing}, 1);
  return (bodies.select(1, 0) + lift).unsqueeze(1) +
         torch::matmul(bones_above(), rotated(rotations, bones));
}

}  // namespace panache
