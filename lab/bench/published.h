#pragma once
// Networks of other motion papers at their published sizes, with random weights, in our kernels. A
// network that blends weights at every frame has to read all of them.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "bench/networks.h"

namespace panache::bench {

// Several layers of one shape, blended at each frame.
struct BlendedLayer {
  std::vector<Layer> sets;

  size_t inputs() const { return static_cast<size_t>(sets.front().inputs); }
  size_t outputs() const { return static_cast<size_t>(sets.front().outputs); }
};

// y = the layer with weights and bias sum(share[s] * set s), applied to x. Blends a few rows at a
// time, so that the blend stays in the L1 cache.
// y.size() = layer.outputs(), x.size() = layer.inputs(), shares.size() = layer.sets.size().
void blended_dense(const BlendedLayer& layer, std::span<const float> shares,
                   std::span<const float> x, std::span<float> y) noexcept;

// The weights of four control points on a closed Catmull-Rom spline at `phase`, 0 to 1.
std::array<float, 4> phase_shares(float phase) noexcept;

// Three layers with ELU between.
using BlendedLayers = std::array<BlendedLayer, 3>;
size_t bytes_of(const BlendedLayers& layers);

// The phase-functioned network of Holden et al. 2017: 342 -> 512 -> 512 -> 311, four sets of
// weights on a spline over the phase.
class PhaseNetwork {
 public:
  static constexpr int kInputs = 342, kHidden = 512, kOutputs = 311, kSets = 4;
  PhaseNetwork();
  // Blends the weights at every call ("cubic").
  void run(std::span<const float> x, float phase, std::span<float> y) noexcept;
  const BlendedLayers& layers() const { return layers_; }
  size_t bytes() const { return bytes_of(layers_); }  // Of all weights; likewise below.

 private:
  BlendedLayers layers_;
  std::array<std::vector<float>, 2> hidden_;
};

// The same with blends for 50 phases, precomputed ("constant").
class PhaseTable {
 public:
  static constexpr int kInputs = PhaseNetwork::kInputs, kOutputs = PhaseNetwork::kOutputs;
  static constexpr int kPhases = 50;
  explicit PhaseTable(const PhaseNetwork& network);
  // Uses the last phase in the table that is not above `phase`.
  void run(std::span<const float> x, float phase, std::span<float> y) noexcept;
  size_t bytes() const;

 private:
  std::vector<std::array<Layer, 3>> layers_;  // [kPhases]
  std::array<std::vector<float>, 2> hidden_;
};

// The mode-adaptive network of Zhang et al. 2018: 480 -> 512 -> 512 -> 363, with eight experts,
// weighted by a gating network 19 -> 32 -> 32 -> 8 on the first inputs.
class ModeNetwork {
 public:
  static constexpr int kInputs = 480, kHidden = 512, kOutputs = 363, kExperts = 8;
  static constexpr int kGatingInputs = 19, kGatingHidden = 32;
  ModeNetwork();
  void run(std::span<const float> x, std::span<float> y) noexcept;
  const BlendedLayers& layers() const { return layers_; }
  const Network& gating() const { return gating_; }
  size_t bytes() const;

 private:
  BlendedLayers layers_;
  Network gating_;
  std::array<std::vector<float>, 2> hidden_;
};

// The phase-functioned network of Mason et al. 2018: 234 -> 512 -> 512 -> 400, four sets, and per
// style an adapter of rank 30 parallel to the second layer, scaled per rank by the phase:
//   second hidden layer = ELU(W h + b + out (scale(phase) * (in h)) + bias).
class StyleAdapterNetwork {
 public:
  static constexpr int kInputs = 234, kHidden = 512, kOutputs = 400, kSets = 4, kRank = 30;
  struct Adapter {
    Layer in;                                     // [kHidden][kRank], no bias.
    Layer out;                                    // [kRank][kHidden]
    std::array<std::vector<float>, kSets> scale;  // [kRank], control points over the phase.
    size_t parameter_count() const;
  };
  StyleAdapterNetwork();
  void run(std::span<const float> x, float phase, std::span<float> y) noexcept;
  const BlendedLayers& layers() const { return layers_; }
  const Adapter& adapter() const { return adapter_; }
  size_t bytes() const;  // With one style.

 private:
  BlendedLayers layers_;
  Adapter adapter_;
  std::array<std::vector<float>, 2> hidden_;
};

}  // namespace panache::bench
