#pragma once
// A trunk of dense layers with ELU between, as read from a model file.

#include <span>
#include <string>
#include <vector>

#include "base/result.h"
#include "net/safetensors.h"

namespace panache {

struct DenseLayer {
  int inputs = 0, outputs = 0;
  std::vector<float> weights;  // [inputs][outputs]
  std::vector<float> bias;     // [outputs]
};

// Reads layer `prefix`.weight [inputs][outputs] and `prefix`.bias [outputs], and checks that the
// shapes are these; -1 accepts any size. Non-finite numbers are refused.
Result<DenseLayer> read_layer(const TensorFile& file, const std::string& prefix, int inputs,
                              int outputs, const std::string& name);

// Hidden layers, each followed by ELU.
class Trunk {
 public:
  // Reads `prefix`.0, `prefix`.1, ... while they are there; the first takes `inputs`.
  static Result<Trunk> read(const TensorFile& file, const std::string& prefix, int inputs,
                            const std::string& name);
  int inputs() const;
  int outputs() const;
  // Numbers that forward() needs to work in.
  size_t scratch_size() const;
  // Returns the last layer's activations, a part of `scratch`. x.size() = inputs().
  std::span<const float> forward(std::span<const float> x, std::span<float> scratch) const noexcept;

 private:
  std::vector<DenseLayer> layers_;
};

}  // namespace panache
