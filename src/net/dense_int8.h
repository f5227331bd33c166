#pragma once
// The arithmetic of dense layers whose weights are int8. Inputs are rounded to
// whole numbers of 14 bits, so that sums are exact in 32 bits: in whatever order an instruction set
// takes them, it gives the same bits.

#include <cstdint>
#include <span>

#include "net/rows.h"

namespace panache {

// Rounded inputs are at most 2^13 in size and weights at most 127: so many products cannot leave
// 32 bits, whatever the numbers are. 2064 * 127 * 2^13 = 2,147,352,576 < 2^31.
inline constexpr int kInputBits = 13;
inline constexpr int kMaxInt8Weight = 127;
inline constexpr size_t kMaxInt8Inputs = 2064;

// Two weights of one input share a 16-bit number: 256 * high + (low + kLowWeightOffset). A kernel
// multiplies the whole number, and its upper byte (one shift), by the input; the sum of the low
// weights is what remains. That takes half the instructions of widening each byte. The whole
// numbers' sum may wrap around: 32 bits of it are enough, because the low weights' sum fits them.
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

// A vector may begin at a layer's last block and be longer.
inline constexpr size_t kInt8Slack = kPadding;

// A layer's numbers, as the kernels want them.
struct Int8Matrix {
  size_t inputs = 0;   // At most kMaxInt8Inputs.
  size_t outputs = 0;  // A multiple of kPadding.
  // [(inputs + 1) / 2][outputs / kPadding][kBlockPairs][2 inputs], packed; an odd last input is
  // paired with zeros. Each weight is at most kMaxInt8Weight in size. kInt8Slack more numbers must
  // be readable behind them.
  const int16_t* weights = nullptr;
  const float* scale = nullptr;  // [outputs]
  const float* bias = nullptr;   // [outputs]
};
// A weight of Int8Matrix::weights of so many outputs, read and written.
int8_t int8_weight(const int16_t* weights, size_t outputs, size_t input, size_t output);
void set_int8_weight(int16_t* weights, size_t outputs, size_t input, size_t output, int8_t weight);

// y[o] = bias[o] + (step * scale[o]) * (sum over i of round(x[i] / step) * weights[i][o]), for each
// row. `step` is a power of two, the smallest for which no x[i] of the row is above 2^13 steps;
// halves are rounded to the even number. Numbers that are not finite, and steps below 2^-100,
// count as 0.
void dense_int8(const Rows<const float>& x, const Int8Matrix& layer, const Rows<float>& y) noexcept;

// The plain loop that the above equals bit for bit.
namespace scalar {
void dense_int8(const Rows<const float>& x, const Int8Matrix& layer, const Rows<float>& y) noexcept;
}

}  // namespace panache
