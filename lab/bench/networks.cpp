#include "bench/networks.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "base/random.h"
#include "net/dense.h"
#include "net/layer.h"
#include "net/mlp.h"
#include "net/rows.h"

namespace panache::bench {
namespace {

constexpr int kHiddenLayers = 3;
constexpr struct { int hidden, outputs; } kSizes[] = {{128, 130}, {64, 1}, {32, 2}};

// The networks named as in a model file: "0.trunk.2.weight", "0.head.bias".
TensorFile tensors_of(std::span<const Network> networks) {
  TensorFile file;
  for (size_t n = 0; n < networks.size(); ++n) {
    const std::vector<Layer>& layers = networks[n].layers;
    for (size_t l = 0; l < layers.size(); ++l) {
      const bool last = l + 1 == layers.size();
      const std::string key = std::to_string(n) + (last ? ".head" : ".trunk." + std::to_string(l));
      file.tensors[key + ".weight"] = {{layers[l].inputs, layers[l].outputs}, layers[l].weights};
      file.tensors[key + ".bias"] = {{layers[l].outputs}, layers[l].bias};
    }
  }
  return file;
}

// As StyleNetworks evaluates a model: all trunks together, then an output layer on each.
class OwnEvaluation : public Evaluation {
 public:
  OwnEvaluation(TrunkTrio trunks, const std::vector<DenseLayer>& heads)
      : trunks_(std::move(trunks)), scratch_(trunks_.scratch_size()) {
    for (const DenseLayer& head : heads) {
      heads_.push_back({PackedLayer(head), static_cast<size_t>(head.outputs), {}});
      heads_.back().out.resize(heads_.back().layer.width());
    }
  }

  void run(std::span<const float> x, std::span<float> y) override {
    const auto hidden = trunks_.forward(x, scratch_);
    for (size_t n = 0; n < heads_.size(); ++n) {
      Head& head = heads_[n];
      head.layer.forward({hidden[n].data(), 1, hidden[n].size()},
                         {head.out.data(), 1, head.out.size()});
      std::copy_n(head.out.begin(), head.outputs, y.begin());
      y = y.subspan(head.outputs);
    }
  }
  std::string library() const override { return std::string("Panache, ") + kernel_target(); }

 private:
  struct Head {
    PackedLayer layer;
    size_t outputs;
    AlignedVector<float> out;  // [layer.width()]
  };
  TrunkTrio trunks_;
  std::vector<Head> heads_;
  AlignedVector<float> scratch_;
};

}  // namespace

std::vector<float> random_numbers(size_t count, uint64_t seed) {
  Random random(seed);
  std::vector<float> numbers(count);
  for (float& number : numbers) number = random.normal();
  return numbers;
}

Layer random_layer(int inputs, int outputs, uint64_t seed) {
  Layer layer{inputs, outputs, random_numbers(static_cast<size_t>(inputs) * outputs, seed),
              std::vector<float>(static_cast<size_t>(outputs), 0.1f)};
  const float deviation = 1.2f / std::sqrt(static_cast<float>(inputs));  // Makes up for ELU.
  for (float& weight : layer.weights) weight *= deviation;
  return layer;
}

std::vector<Network> slides_networks() {
  std::vector<Network> networks;
  uint64_t seed = 1;
  for (const auto& [hidden, outputs] : kSizes) {
    Network network;
    int inputs = kSlidesInputs;
    for (int l = 0; l < kHiddenLayers; ++l) {
      network.layers.push_back(random_layer(inputs, hidden, seed++));
      inputs = hidden;
    }
    network.layers.push_back(random_layer(inputs, outputs, seed++));
    networks.push_back(std::move(network));
  }
  return networks;
}

size_t parameter_count(std::span<const Network> networks) {
  size_t count = 0;
  for (const Network& network : networks) {
    for (const Layer& layer : network.layers) count += layer.weights.size() + layer.bias.size();
  }
  return count;
}

void run_plainly(std::span<const Network> networks, std::span<const float> x, std::span<float> y) {
  for (const Network& network : networks) {
    std::vector<float> in(x.begin(), x.end()), out;
    for (size_t l = 0; l < network.layers.size(); ++l) {
      const Layer& layer = network.layers[l];
      out.resize(layer.bias.size());
      scalar::dense(in, layer.weights, layer.bias, out);
      if (l + 1 < network.layers.size()) scalar::elu(out);
      std::swap(in, out);
    }
    std::copy(in.begin(), in.end(), y.begin());
    y = y.subspan(in.size());
  }
}

Result<std::unique_ptr<Evaluation>> make_own_evaluation(std::span<const Network> networks,
                                                        bool int8) {
  assert(networks.size() == TrunkTrio::kTrunks);
  const TensorFile floats = tensors_of(networks);
  const TensorFile file = int8 ? quantize(floats) : floats;
  std::array<Trunk, TrunkTrio::kTrunks> trunks;
  std::vector<DenseLayer> heads;
  for (size_t n = 0; n < networks.size(); ++n) {
    const std::string key = std::to_string(n);
    Result<Trunk> trunk =
        Trunk::read(file, key + ".trunk", networks[n].layers.front().inputs, "networks");
    if (!trunk) return trunk.error();
    Result<DenseLayer> head = read_layer(file, key + ".head", trunk->outputs(), -1, "networks");
    if (!head) return head.error();
    trunks[n] = *std::move(trunk);
    heads.push_back(*std::move(head));
  }
  return std::unique_ptr<Evaluation>(
      std::make_unique<OwnEvaluation>(TrunkTrio(std::move(trunks)), heads));
}

}  // namespace panache::bench
