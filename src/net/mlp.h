#pragma once
// Trunks of dense layers with ELU between, as read from a model file.

#include <array>
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
  friend class TrunkTrio;
  std::vector<DenseLayer> layers_;
};

// Three trunks that read the same input: their first layers stand in one matrix, so that the input
// is gone through once. Bit for bit what each trunk gives by itself.
class TrunkTrio {
 public:
  static constexpr size_t kTrunks = 3;

  TrunkTrio() = default;
  // All trunks take the same number of inputs.
  explicit TrunkTrio(std::array<Trunk, kTrunks> trunks);

  int inputs() const { return first_.inputs; }
  int outputs(size_t trunk) const { return outputs_[trunk]; }
  size_t scratch_size() const;  // Numbers that forward() needs to work in.
  // Returns the last activations of each trunk, parts of `scratch`. x.size() = inputs().
  std::array<std::span<const float>, kTrunks> forward(std::span<const float> x,
                                                      std::span<float> scratch) const noexcept;

 private:
  DenseLayer first_;                    // The columns of trunk 0, then of 1, then of 2.
  std::array<int, kTrunks> widths_{};   // Of each trunk's first layer,
  std::array<int, kTrunks> outputs_{};  // and of its last.
  std::array<Trunk, kTrunks> rest_;     // The other layers; may have none.
};

}  // namespace panache
