#pragma once
// The networks of Smith et al. 2019 at the sizes of the paper's slides, with random weights, for
// comparing our kernels with other libraries.

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/result.h"

namespace panache::bench {

struct Layer {
  int inputs = 0, outputs = 0;
  std::vector<float> weights;  // [inputs][outputs]
  std::vector<float> bias;     // [outputs]
};
// Layers with ELU after each but the last.
struct Network {
  std::vector<Layer> layers;
};

// A random layer from `seed` whose outputs have about the magnitude of its inputs.
Layer random_layer(int inputs, int outputs, uint64_t seed);
// Approximately standard normal numbers.
std::vector<float> random_numbers(size_t count, uint64_t seed);

// 794 inputs (six poses and the style vector), three hidden layers of 128, 64 and 32 units, outputs
// for pose (130), timing (1) and contact (2).
inline constexpr int kSlidesInputs = 794, kSlidesOutputs = 133;
std::vector<Network> slides_networks();
size_t parameter_count(std::span<const Network> networks);

// The networks in some library, evaluated on the same input. Copies what it needs of the networks.
class Evaluation {
 public:
  virtual ~Evaluation() = default;
  // x[kSlidesInputs]; y[kSlidesOutputs]: the networks' outputs, one after the other.
  virtual void run(std::span<const float> x, std::span<float> y) = 0;
  // The library's name and version, for display.
  virtual std::string library() const = 0;
};

// A reference implementation in plain loops, to check all others.
void run_plainly(std::span<const Network> networks, std::span<const float> x, std::span<float> y);

// The networks in our own kernels, evaluated as StyleNetworks evaluates a model; with `int8`,
// weights are quantized (net/layer.h).
Result<std::unique_ptr<Evaluation>> make_own_evaluation(std::span<const Network> networks,
                                                        bool int8);

}  // namespace panache::bench
