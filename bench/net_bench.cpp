// How long the three networks of Smith et al. 2019 take for one character and one frame: 794
// inputs, three hidden layers of 128, 64 and 32 units, outputs for pose (130), timing (1) and
// contact (2). Compares the vectorised kernels with the plain loops that define them, in one run.

#include <cmath>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <benchmark/benchmark.h>

#include "net/dense.h"
#include "net/mlp.h"

namespace {

using namespace panache;

constexpr int kInputs = 794;
constexpr int kHiddenLayers = 3;
constexpr struct { int hidden, outputs; } kSizes[] = {{128, 130}, {64, 1}, {32, 2}};

struct Network {
  std::vector<DenseLayer> layers;  // The last one has no ELU behind it.
};

std::vector<Network> make_networks() {
  std::mt19937 random(1);
  std::vector<Network> networks;
  for (const auto& [hidden, outputs] : kSizes) {
    Network network;
    int inputs = kInputs;
    for (int layer = 0; layer <= kHiddenLayers; ++layer) {
      const int units = layer < kHiddenLayers ? hidden : outputs;
      // Wide enough to keep activations of every layer near 1.
      std::normal_distribution<float> normal(0, 1.2f / std::sqrt(static_cast<float>(inputs)));
      DenseLayer dense_layer{inputs, units, {}, std::vector<float>(units, 0.1f)};
      dense_layer.weights.resize(static_cast<size_t>(inputs) * units);
      for (float& w : dense_layer.weights) w = normal(random);
      network.layers.push_back(std::move(dense_layer));
      inputs = units;
    }
    networks.push_back(std::move(network));
  }
  return networks;
}

template <auto kDense, auto kElu>
void three_networks(benchmark::State& state) {
  const std::vector<Network> networks = make_networks();
  std::mt19937 random(2);
  std::normal_distribution<float> normal;
  std::vector<float> input(kInputs),
      scratch[2] = {std::vector<float>(kInputs), std::vector<float>(kInputs)};
  for (float& v : input) v = normal(random);
  size_t bytes = 0;
  for (const Network& network : networks) {
    for (const DenseLayer& l : network.layers) bytes += 4 * (l.weights.size() + l.bias.size());
  }
  for (auto _ : state) {
    for (const Network& network : networks) {
      std::span<const float> x = input;
      for (size_t l = 0; l < network.layers.size(); ++l) {
        const DenseLayer& layer = network.layers[l];
        const std::span<float> y = std::span(scratch[l % 2]).first(layer.outputs);
        kDense(x, layer.weights, layer.bias, y);
        if (l + 1 < network.layers.size()) kElu(y);
        x = y;
      }
      benchmark::DoNotOptimize(x.data());
    }
    benchmark::ClobberMemory();
  }
  state.SetBytesProcessed(static_cast<int64_t>(state.iterations() * bytes));
  state.SetLabel(std::to_string(bytes / 1000) + " kB of weights, " + kernel_target());
}

void vectorised(benchmark::State& state) { three_networks<dense, elu>(state); }
void plain_loops(benchmark::State& state) { three_networks<scalar::dense, scalar::elu>(state); }
BENCHMARK(vectorised)->Unit(benchmark::kMicrosecond);
BENCHMARK(plain_loops)->Unit(benchmark::kMicrosecond);

// The layers that weigh most, alone.
template <auto kDense>
void one_layer(benchmark::State& state) {
  const size_t inputs = state.range(0), outputs = state.range(1);
  std::mt19937 random(3);
  std::normal_distribution<float> normal;
  std::vector<float> x(inputs), weights(inputs * outputs), bias(outputs), y(outputs);
  for (float& v : x) v = normal(random);
  for (float& v : weights) v = normal(random);
  for (auto _ : state) {
    kDense(x, weights, bias, y);
    benchmark::DoNotOptimize(y.data());
    benchmark::ClobberMemory();
  }
  state.SetBytesProcessed(static_cast<int64_t>(state.iterations() * weights.size() * 4));
}

void vectorised_layer(benchmark::State& state) { one_layer<dense>(state); }
void plain_layer(benchmark::State& state) { one_layer<scalar::dense>(state); }
void sizes(benchmark::internal::Benchmark* b) {
  for (const auto& [inputs, outputs] :
       {std::pair{794, 128}, {794, 64}, {794, 32}, {396, 128}, {128, 128}, {128, 67}, {64, 1}}) {
    b->Args({inputs, outputs});
  }
}
BENCHMARK(vectorised_layer)->Apply(sizes)->Unit(benchmark::kMicrosecond);
BENCHMARK(plain_layer)->Apply(sizes)->Unit(benchmark::kMicrosecond);

}  // namespace

BENCHMARK_MAIN();
