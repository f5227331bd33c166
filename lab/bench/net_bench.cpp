// How long the three networks of Smith et al. 2019 take for one character and one frame: 794
// inputs, three hidden layers of 128, 64 and 32 units, outputs for pose (130), timing (1) and
// contact (2). Compares the vectorised kernels with the plain loops that define them, in one run.

#include <array>
#include <cmath>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <benchmark/benchmark.h>

#include "net/dense.h"
#include "net/mlp.h"
#include "net/quantize.h"

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

// The same networks as a model holds them: the three first layers in one matrix, rows padded.
TensorFile make_file() {
  TensorFile file;
  const std::vector<Network> networks = make_networks();
  for (size_t n = 0; n < networks.size(); ++n) {
    for (size_t l = 0; l < networks[n].layers.size(); ++l) {
      const DenseLayer& layer = networks[n].layers[l];
      const std::string key = "network" + std::to_string(n) +
                              (l < kHiddenLayers ? ".trunk." + std::to_string(l) : ".head");
      file.tensors[key + ".weight"] = {{layer.inputs, layer.outputs}, layer.weights};
      file.tensors[key + ".bias"] = {{layer.outputs}, layer.bias};
    }
  }
  return file;
}

// Forward passes of so many characters at once.
void packed_networks(benchmark::State& state, const TensorFile& file) {
  const size_t rows = static_cast<size_t>(state.range(0));
  std::array<Trunk, 3> trunks;
  std::array<PackedLayer, 3> heads;
  for (size_t n = 0; n < 3; ++n) {
    const std::string key = "network" + std::to_string(n);
    trunks[n] = *Trunk::read(file, key + ".trunk", kInputs, "made up");
    heads[n] = PackedLayer(*read_layer(file, key + ".head", -1, -1, "made up"));
  }
  const TrunkTrio trio(std::move(trunks));
  std::mt19937 random(2);
  std::normal_distribution<float> normal;
  AlignedVector<float> input(kInputs * rows), scratch(trio.scratch_size(rows)), out(256 * rows);
  for (float& v : input) v = normal(random);
  for (auto _ : state) {
    const auto hidden =
        trio.forward(Rows<const float>{input.data(), rows, kInputs}, std::span(scratch));
    for (size_t n = 0; n < 3; ++n) heads[n].forward(hidden[n], {out.data(), rows, 256});
    benchmark::DoNotOptimize(out.data());
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(static_cast<int64_t>(state.iterations() * rows));
}
void packed(benchmark::State& state) { packed_networks(state, make_file()); }
void int8_weights(benchmark::State& state) { packed_networks(state, quantize(make_file())); }
BENCHMARK(packed)->Arg(1)->Arg(8)->Arg(16)->Unit(benchmark::kMicrosecond);
BENCHMARK(int8_weights)->Arg(1)->Arg(8)->Arg(16)->Unit(benchmark::kMicrosecond);

// How fast the caches give what the networks weigh: reading and adding up so many bytes, as fast as
// the kernels' instruction set allows.
void read_once(benchmark::State& state) {
  AlignedVector<float> weights(static_cast<size_t>(state.range(0)) / 4, 1.0f);
  for (auto _ : state) {
    benchmark::DoNotOptimize(sum_in_any_order(weights));
    benchmark::ClobberMemory();
  }
  state.SetBytesProcessed(static_cast<int64_t>(state.iterations()) * state.range(0));
}
BENCHMARK(read_once)->Arg(953344)->Arg(953344 / 4)->Unit(benchmark::kMicrosecond);

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
