#pragma once
// Dense layers: as read from a file, as laid out for the kernels, and with int8 weights, a
// quarter of the memory that each step reads.

#include <cstdint>
#include <span>
#include <vector>

#include "net/rows.h"
#include "net/safetensors.h"

namespace panache {

struct DenseLayer {
  int inputs = 0, outputs = 0;
  std::vector<float> weights;  // [inputs][outputs]
  std::vector<float> bias;     // [outputs]
  // If the file has int8 weights: these, and the scale of each column. `weights` then holds their
  // products. Otherwise empty.
  std::vector<int8_t> int8_weights = {};  // [inputs][outputs], at most 127 in magnitude.
  std::vector<float> scale = {};          // [outputs]
};

// Concatenates the outputs of the layers in one layer of floats. All have the same inputs.
DenseLayer side_by_side(std::span<const DenseLayer> layers);

// One or several layers of the same inputs, side by side in one matrix: the input is read once, and
// the bits are those of separate layers. Weights are int8 (dense_int8.h) if all the layers' are,
// otherwise floats (dense.h).
class PackedLayer {
 public:
  PackedLayer() = default;
  explicit PackedLayer(const DenseLayer& layer) : PackedLayer(std::span(&layer, 1)) {}
  explicit PackedLayer(std::span<const DenseLayer> layers);

  size_t inputs() const { return inputs_; }
  // Length of a row of outputs. Each layer starts at a multiple of kPadding, padded with zeros.
  size_t width() const { return bias_.size(); }
  // Where the outputs of layer `l` start.
  size_t begin(size_t l) const { return begins_[l]; }
  // Computes width() numbers in each row of y from inputs() numbers in each row of x.
  void forward(const Rows<const float>& x, const Rows<float>& y) const noexcept;

 private:
  size_t inputs_ = 0;
  std::vector<size_t> begins_;
  AlignedVector<float> weights_;  // [inputs][width], or empty:
  AlignedVector<int16_t> int8_;   // then pairs of int8, see Int8Matrix.
  AlignedVector<float> scale_;    // [width], for int8 only.
  AlignedVector<float> bias_;     // [width]
};

// Quantizes the weights of all dense layers (every matrix `X.weight` with a bias `X.bias`) to int8;
// `X.scale` holds the scale of each column. Small layers with fewer than kPadding outputs, and
// those with more than kMaxInt8Inputs inputs, stay as they are, as does everything else. Trunk and
// TrunkTrio read and evaluate the result as before. Weights must be finite.
TensorFile quantize(const TensorFile& file);

// Whether any of the file's tensors is int8.
bool is_quantized(const TensorFile& file);

}  // namespace panache
