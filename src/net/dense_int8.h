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

// A layer's numbers, as the kernels want them.
struct Int8Matrix {
  size_t inputs = 0;                // At most kMaxInt8Inputs.
  size_t outputs = 0;               // A multiple of kPadding.
  const int8_t* weights = nullptr;  // [(inputs + 1) / 2][outputs][2]: pairs of inputs; an odd last
                                    // one is paired with zeros. At most kMaxInt8Weight in size.
  const float* scale = nullptr;     // [outputs]
  const float* bias = nullptr;      // [outputs]
};

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
