// The plain loops. They define the result, so they stand apart from the code that is compiled once
// per instruction set.
#include "net/dense.h"

#include <bit>
#include <cassert>
#include <cstddef>

#include "net/exponential.h"

namespace panache::scalar {
namespace {

// exp(x) - 1 for x <= 0; NaN for NaN. Each line is one operation of the vectorised kernel.
float expm1_below_zero(float x) {
  using namespace exponential;
  x = x < kLowest ? kLowest : x;
  const float shifted = x * kLog2E + kRound;
  const float n = shifted - kRound;
  const float r = (x - n * kLn2High) - n * kLn2Low;
  float series = kSeries[5];
  for (int k = 4; k >= 0; --k) series = series * r + kSeries[k];
  const float power = r + (r * r) * series;
  const float scale =
      std::bit_cast<float>((std::bit_cast<uint32_t>(shifted) << kMantissaBits) + kOneBits);
  return scale * power + (scale - 1.0f);
}

}  // namespace

void dense(std::span<const float> x, std::span<const float> weights, std::span<const float> bias,
           std::span<float> y) noexcept {
  assert(bias.size() == y.size() && weights.size() == x.size() * y.size());
  const size_t outputs = y.size();
  for (size_t o = 0; o < outputs; ++o) y[o] = bias[o];
  for (size_t i = 0; i < x.size(); ++i) {
    const float* row = weights.data() + i * outputs;
    for (size_t o = 0; o < outputs; ++o) y[o] = y[o] + x[i] * row[o];
  }
}

void elu(std::span<float> y) noexcept {
  for (float& v : y) v = v > 0 ? v : expm1_below_zero(v);
}

void add_scaled(float a, std::span<const float> x, std::span<float> y) noexcept {
  assert(x.size() == y.size());
  for (size_t i = 0; i < y.size(); ++i) y[i] = y[i] + a * x[i];
}

void standardise(std::span<const float> x, std::span<const float> mean,
                 std::span<const float> factor, float clip, std::span<float> y) noexcept {
  assert(x.size() == y.size() && mean.size() == y.size() && factor.size() == y.size());
  for (size_t i = 0; i < y.size(); ++i) {
    const float v = (x[i] - mean[i]) * factor[i];
    y[i] = v < -clip ? -clip : v > clip ? clip : v;
  }
}

float square_length(std::span<const float> x) noexcept {
  float parts[kPadding] = {};
  for (size_t i = 0; i < x.size(); ++i) parts[i % kPadding] += x[i] * x[i];
  for (size_t half = kPadding / 2; half > 0; half /= 2) {
    for (size_t p = 0; p < half; ++p) parts[p] += parts[p + half];
  }
  return parts[0];
}

}  // namespace panache::scalar
