#include "bench/published.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "net/dense.h"

namespace panache::bench {
namespace {

// Numbers of a partial blend, 16 KB: fits into an L1 cache together with as many of one set.
constexpr size_t kBlendNumbers = 4096;
constexpr size_t kMaxOutputs = 1024;

BlendedLayers random_layers(int inputs, int hidden, int outputs, int sets, uint64_t seed) {
  const int sizes[] = {inputs, hidden, hidden, outputs};
  BlendedLayers layers;
  for (size_t l = 0; l < layers.size(); ++l) {
    for (int s = 0; s < sets; ++s) {
      layers[l].sets.push_back(random_layer(sizes[l], sizes[l + 1], seed++));
    }
  }
  return layers;
}

// out = sum(share[s] * set_numbers(s)).
template <class Numbers>
void blend(std::span<const float> shares, const Numbers& set_numbers, std::span<float> out) {
  std::fill(out.begin(), out.end(), 0.0f);
  for (size_t s = 0; s < shares.size(); ++s) add_scaled(shares[s], set_numbers(s), out);
}

void softmax(std::span<float> values) {
  const float max = *std::max_element(values.begin(), values.end());
  float total = 0;
  for (float& v : values) total += v = std::exp(v - max);
  for (float& v : values) v /= total;
}

}  // namespace

void blended_dense(const BlendedLayer& layer, std::span<const float> shares,
                   std::span<const float> x, std::span<float> y) noexcept {
  const size_t inputs = layer.inputs(), outputs = layer.outputs();
  assert(shares.size() == layer.sets.size() && x.size() == inputs && y.size() == outputs);
  assert(outputs <= kMaxOutputs);
  alignas(64) std::array<float, kBlendNumbers> weights;
  alignas(64) std::array<float, kMaxOutputs> so_far;
  blend(
      shares, [&](size_t s) { return std::span(layer.sets[s].bias); }, y);
  const size_t block = kBlendNumbers / outputs;
  for (size_t row = 0; row < inputs; row += block) {
    const size_t rows = std::min(block, inputs - row);
    const std::span<float> part = std::span(weights).first(rows * outputs);
    blend(
        shares,
        [&](size_t s) {
          return std::span(layer.sets[s].weights).subspan(row * outputs, part.size());
        },
        part);
    std::copy(y.begin(), y.end(), so_far.begin());
    dense(x.subspan(row, rows), part, std::span(so_far).first(outputs), y);
  }
}

std::array<float, 4> phase_shares(float phase) noexcept {
  const float position = 4 * phase;
  const int at = static_cast<int>(position);
  const float t = position - static_cast<float>(at), t2 = t * t, t3 = t2 * t;
  const float along[4] = {-0.5f * t3 + t2 - 0.5f * t, 1.5f * t3 - 2.5f * t2 + 1,
                          -1.5f * t3 + 2 * t2 + 0.5f * t, 0.5f * t3 - 0.5f * t2};
  std::array<float, 4> shares{};
  // Along the curve: the point before, the two around the phase, the point after.
  for (int k = 0; k < 4; ++k) shares[static_cast<size_t>((at + k + 3) % 4)] = along[k];
  return shares;
}

size_t bytes_of(const BlendedLayers& layers) {
  size_t numbers = 0;
  for (const BlendedLayer& layer : layers) {
    numbers += layer.sets.size() * (layer.inputs() + 1) * layer.outputs();
  }
  return sizeof(float) * numbers;
}

PhaseNetwork::PhaseNetwork()
    : layers_(random_layers(kInputs, kHidden, kOutputs, kSets, 100)),
      hidden_{std::vector<float>(kHidden), std::vector<float>(kHidden)} {}

void PhaseNetwork::run(std::span<const float> x, float phase, std::span<float> y) noexcept {
  const std::array<float, 4> shares = phase_shares(phase);
  blended_dense(layers_[0], shares, x, hidden_[0]);
  elu(hidden_[0]);
  blended_dense(layers_[1], shares, hidden_[0], hidden_[1]);
  elu(hidden_[1]);
  blended_dense(layers_[2], shares, hidden_[1], y);
}

PhaseTable::PhaseTable(const PhaseNetwork& network)
    : hidden_{std::vector<float>(PhaseNetwork::kHidden),
              std::vector<float>(PhaseNetwork::kHidden)} {
  for (int p = 0; p < kPhases; ++p) {
    const std::array<float, 4> shares = phase_shares(static_cast<float>(p) / kPhases);
    std::array<Layer, 3> layers;
    for (size_t l = 0; l < layers.size(); ++l) {
      const BlendedLayer& from = network.layers()[l];
      Layer& to = layers[l];
      to.inputs = static_cast<int>(from.inputs());
      to.outputs = static_cast<int>(from.outputs());
      to.weights.resize(from.inputs() * from.outputs());
      to.bias.resize(from.outputs());
      blend(
          shares, [&](size_t s) { return std::span(from.sets[s].weights); }, to.weights);
      blend(
          shares, [&](size_t s) { return std::span(from.sets[s].bias); }, to.bias);
    }
    layers_.push_back(std::move(layers));
  }
}

void PhaseTable::run(std::span<const float> x, float phase, std::span<float> y) noexcept {
  const int index = std::clamp(static_cast<int>(phase * kPhases), 0, kPhases - 1);
  const std::array<Layer, 3>& layers = layers_[static_cast<size_t>(index)];
  dense(x, layers[0].weights, layers[0].bias, hidden_[0]);
  elu(hidden_[0]);
  dense(hidden_[0], layers[1].weights, layers[1].bias, hidden_[1]);
  elu(hidden_[1]);
  dense(hidden_[1], layers[2].weights, layers[2].bias, y);
}

size_t PhaseTable::bytes() const {
  size_t numbers = 0;
  for (const Layer& layer : layers_.front()) numbers += layer.weights.size() + layer.bias.size();
  return sizeof(float) * numbers * layers_.size();
}

ModeNetwork::ModeNetwork()
    : layers_(random_layers(kInputs, kHidden, kOutputs, kExperts, 200)),
      gating_{{random_layer(kGatingInputs, kGatingHidden, 300),
               random_layer(kGatingHidden, kGatingHidden, 301),
               random_layer(kGatingHidden, kExperts, 302)}},
      hidden_{std::vector<float>(kHidden), std::vector<float>(kHidden)} {}

void ModeNetwork::run(std::span<const float> x, std::span<float> y) noexcept {
  std::array<float, kGatingHidden> first, second;
  std::array<float, kExperts> shares;
  const auto& gating = gating_.layers;
  dense(x.first(kGatingInputs), gating[0].weights, gating[0].bias, first);
  elu(first);
  dense(first, gating[1].weights, gating[1].bias, second);
  elu(second);
  dense(second, gating[2].weights, gating[2].bias, shares);
  softmax(shares);
  blended_dense(layers_[0], shares, x, hidden_[0]);
  elu(hidden_[0]);
  blended_dense(layers_[1], shares, hidden_[0], hidden_[1]);
  elu(hidden_[1]);
  blended_dense(layers_[2], shares, hidden_[1], y);
}

size_t ModeNetwork::bytes() const {
  return bytes_of(layers_) + sizeof(float) * parameter_count({&gating_, 1});
}

size_t StyleAdapterNetwork::Adapter::parameter_count() const {
  size_t count = in.weights.size() + out.weights.size() + out.bias.size();
  for (const std::vector<float>& point : scale) count += point.size();
  return count;
}

StyleAdapterNetwork::StyleAdapterNetwork()
    : layers_(random_layers(kInputs, kHidden, kOutputs, kSets, 400)),
      adapter_{random_layer(kHidden, kRank, 500), random_layer(kRank, kHidden, 501), {}},
      hidden_{std::vector<float>(kHidden), std::vector<float>(kHidden)} {
  std::fill(adapter_.in.bias.begin(), adapter_.in.bias.end(), 0.0f);  // It has none.
  for (size_t s = 0; s < kSets; ++s) adapter_.scale[s] = random_numbers(kRank, 600 + s);
}

size_t StyleAdapterNetwork::bytes() const {
  return bytes_of(layers_) + sizeof(float) * adapter_.parameter_count();
}

void StyleAdapterNetwork::run(std::span<const float> x, float phase, std::span<float> y) noexcept {
  const std::array<float, 4> shares = phase_shares(phase);
  blended_dense(layers_[0], shares, x, hidden_[0]);
  elu(hidden_[0]);
  blended_dense(layers_[1], shares, hidden_[0], hidden_[1]);
  std::array<float, kRank> ranks, scale;
  std::array<float, kHidden> added;
  dense(hidden_[0], adapter_.in.weights, adapter_.in.bias, ranks);
  blend(
      shares, [&](size_t s) { return std::span(adapter_.scale[s]); }, scale);
  for (size_t r = 0; r < kRank; ++r) ranks[r] *= scale[r];
  dense(ranks, adapter_.out.weights, adapter_.out.bias, added);
  add_scaled(1, added, hidden_[1]);
  elu(hidden_[1]);
  blended_dense(layers_[2], shares, hidden_[1], y);
}

}  // namespace panache::bench
