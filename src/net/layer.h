#pragma once
// Dense layers: as read from a file, and as laid out for the kernels.

#include <cstdint>
#include <span>
#include <vector>

#include "net/aligned_vector.h"
#include "net/rows.h"

namespace panache {

struct DenseLayer {
  int inputs = 0, outputs = 0;
  std::vector<float> weights;  // [inputs][outputs]
  std::vector<float> bias;     // [outputs]
  // If the file has int8 weights: these, and their scale
  // in each column. `weights` are then their products. Otherwise empty.
  std::vector<int8_t> int8_weights = {};  // [inputs][outputs], at most 127 in size.
  std::vector<float> scale = {};          // [outputs]
};

// The layers' outputs one after another, as one layer of floats. All have the same inputs.
DenseLayer side_by_side(std::span<const DenseLayer> layers);

// One or several layers of the same inputs, side by side in one matrix: the input is gone through
// once, with the bits that each layer gives alone. Weights are bytes (dense_int8.h) where those of
// all the layers are, else floats (dense.h).
class PackedLayer {
 public:
  PackedLayer() = default;
  explicit PackedLayer(const DenseLayer& layer) : PackedLayer(std::span(&layer, 1)) {}
  explicit PackedLayer(std::span<const DenseLayer> layers);

  size_t inputs() const { return inputs_; }
  // Numbers in a row of outputs. Each layer's begin at a multiple of kPadding; zeros follow them.
  size_t width() const { return bias_.size(); }
  // Where the outputs of layer `l` begin.
  size_t begin(size_t l) const { return begins_[l]; }
  // Computes width() numbers in each row of y from inputs() numbers in each row of x.
  void forward(const Rows<const float>& x, const Rows<float>& y) const noexcept;

 private:
  size_t inputs_ = 0;
  std::vector<size_t> begins_;
  AlignedVector<float> weights_;  // [inputs][width], or none:
  AlignedVector<int16_t> int8_;   // pairs of int8, see Int8Matrix.
  AlignedVector<float> scale_;    // [width], of bytes.
  AlignedVector<float> bias_;     // [width]
};

}  // namespace panache
