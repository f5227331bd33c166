#pragma once
// Trunks of dense layers with ELU between, as read from a model file.

#include <array>
#include <span>
#include <string>
#include <vector>

#include "base/result.h"
#include "net/layer.h"
#include "net/safetensors.h"

namespace panache {

// Reads layer `prefix`.weight [inputs][outputs] and `prefix`.bias [outputs] and checks their
// shapes; -1 accepts any size. For int8 weights, `prefix`.scale [outputs] is their unit. Rejects
// non-finite numbers, and int8 values outside the kernels' range.
Result<DenseLayer> read_layer(const TensorFile& file, const std::string& prefix, int inputs,
                              int outputs, const std::string& name);

// Reads the tensor `key`, which must hold `size` finite numbers in one row.
Result<std::vector<float>> read_vector(const TensorFile& file, const std::string& key, int size,
                                       const std::string& name);

// Hidden layers, each followed by ELU.
class Trunk {
 public:
  // Reads `prefix`.0, `prefix`.1, ... as far as they exist; the first takes `inputs`.
  static Result<Trunk> read(const TensorFile& file, const std::string& prefix, int inputs,
                            const std::string& name);
  // A trunk without units, for a missing network.
  static Trunk none(int inputs);
  int inputs() const;
  int outputs() const;
  int widest() const;    // The outputs of the widest layer.
  bool is_int8() const;  // Whether the first layer has int8 weights.
  // The scratch size of forward(), in numbers.
  size_t scratch_size() const { return trunk_scratch_size(1); }
  // Returns the last layer's activations, a part of `scratch`. x.size() = inputs().
  std::span<const float> forward(std::span<const float> x, std::span<float> scratch) const noexcept;

 private:
  friend class TrunkTrio;
  // The same for several rows at once.
  size_t trunk_scratch_size(size_t rows) const;
  Rows<const float> forward(const Rows<const float>& x, std::span<float> scratch) const noexcept;

  std::vector<DenseLayer> plain_;  // As read.
  std::vector<PackedLayer> layers_;
};

// Three trunks that read the same input; their first layers share one matrix, so that the input is
// read once. The bits are those of separate trunks, unless only some of the first layers are int8:
// their weights are then used as floats.
class TrunkTrio {
 public:
  static constexpr size_t kTrunks = 3;

  TrunkTrio() = default;
  // All trunks take the same number of inputs.
  explicit TrunkTrio(std::array<Trunk, kTrunks> trunks);

  int inputs() const { return static_cast<int>(first_.inputs()); }
  int outputs(size_t trunk) const { return static_cast<int>(outputs_[trunk].back()); }
  // The scratch size of forward() for this many rows, in numbers.
  size_t scratch_size(size_t rows = 1) const;
  // Returns the last activations of each trunk, parts of `scratch`. x.size() = inputs().
  std::array<std::span<const float>, kTrunks> forward(std::span<const float> x,
                                                      std::span<float> scratch) const noexcept;
  // The same for each row of x, with the bits of separate calls. `scratch` should begin on a cache
  // line.
  std::array<Rows<const float>, kTrunks> forward(const Rows<const float>& x,
                                                 std::span<float> scratch) const noexcept;

  // The total outputs of all hidden layers of a trunk.
  size_t all_outputs(size_t trunk) const;
  // The activations of all hidden layers of a trunk, first layer first, for one of the `rows` rows
  // for which forward() filled `scratch`. out.size() = all_outputs(trunk).
  void all_layers(size_t trunk, size_t row, size_t rows, std::span<const float> scratch,
                  std::span<float> out) const noexcept;

 private:
  PackedLayer first_;  // The layers of trunk 0, then of 1, then of 2.
  std::array<std::vector<size_t>, kTrunks> outputs_;  // Of each layer in each trunk.
  std::array<Trunk, kTrunks> rest_;                   // The other layers; may be empty.
};

}  // namespace panache
