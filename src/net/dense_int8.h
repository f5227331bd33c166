#pragma once
// The arithmetic of dense layers with int8 weights. Inputs are rounded to 14-bit integers, so that
// sums are exact in 32 bits: any order of addition gives the same bits.

#include <cstdint>
#include <span>

#include "net/rows.h"

namespace panache {

// Rounded inputs are at most 2^13 in magnitude and weights at most 127, so the sum of
// kMaxInt8Inputs products always fits 32 bits. 2064 * 127 * 2^13 = 2,147,352,576 < 2^31.
inline constexpr int kInputBits = 13;
inline constexpr int kMaxInt8Weight = 127;
inline constexpr size_t kMaxInt8Inputs = 2064;

// Two weights of one input share a 16-bit integer: 256 * high + (low + kLowWeightOffset). A kernel
// multiplies both the integer and its upper byte (one shift) by the input; the sum for the low
// weights is the remainder. That takes half the instructions of widening each byte. The sum of the
// integers may wrap around, because the sum for the low weights fits 32 bits.
inline constexpr int kLowWeightOffset = 128;
constexpr int16_t packed_weights(int8_t low, int8_t high) {
  return static_cast<int16_t>(256 * high + (low + kLowWeightOffset));
}
constexpr int8_t low_weight(int16_t packed) {
  return static_cast<int8_t>((packed & 255) - kLowWeightOffset);
}
constexpr int8_t high_weight(int16_t packed) { return static_cast<int8_t>(packed >> 8); }

// Outputs are packed in blocks of kPadding: output o < kBlockPairs of a block with o + kBlockPairs.
inline constexpr size_t kBlockPairs = kPadding / 2;

// A vector that starts at a layer's last block may extend beyond it.
inline constexpr size_t kInt8Slack = kPadding;

// A layer's parameters, laid out for the kernels.
struct Int8Matrix {
  size_t inputs = 0;   // At most kMaxInt8Inputs.
  size_t outputs = 0;  // A multiple of kPadding.
  // [(inputs + 1) / 2][outputs / kPadding][kBlockPairs][2 inputs], packed; an odd last input is
  // paired with zeros. Each weight is at most kMaxInt8Weight in magnitude. kInt8Slack more numbers
  // must be readable behind them.
  const int16_t* weights = nullptr;
  const float* scale = nullptr;  // [outputs]
  const float* bias = nullptr;   // [outputs]
};
// Read and write a weight in Int8Matrix::weights.
int8_t int8_weight(const int16_t* weights, size_t outputs, size_t input, size_t output);
void set_int8_weight(int16_t* weights, size_t outputs, size_t input, size_t output, int8_t weight);

// y[o] = bias[o] + (step * scale[o]) * (sum over i of round(x[i] / step) * weights[i][o]), for each
// row. `step` is the smallest power of two for which no x[i] of the row exceeds 2^13 steps; ties
// round to even. Non-finite numbers, and steps below 2^-100, count as 0.
void dense_int8(const Rows<const float>& x, const Int8Matrix& layer, const Rows<float>& y) noexcept;

// The plain loop that the above equals bit for bit.
namespace scalar {
void dense_int8(const Rows<const float>& x, const Int8Matrix& layer, const Rows<float>& y) noexcept;
}

}  // namespace panache
