#pragma once
// The arithmetic of small dense networks. Each kernel exists twice: a plain loop, which defines the
// result, and a vectorised one with the same bits on every instruction set: one lane per output, no
// fused multiply-add, inputs in order, our own exponential.

#include <span>

#include "net/rows.h"

namespace panache {

// y[o] = bias[o] + sum over i, in order, of x[i] * weights[i][o]. weights[in][out], in = x.size(),
// out = y.size() = bias.size(). No argument may overlap y.
void dense(std::span<const float> x, std::span<const float> weights, std::span<const float> bias,
           std::span<float> y) noexcept;
// The same for each row of x, with `inputs` numbers, and of y, with bias.size() outputs. The bits
// are those of separate calls, but weights are read once for several rows.
void dense_rows(const Rows<const float>& x, size_t inputs, std::span<const float> weights,
                std::span<const float> bias, const Rows<float>& y) noexcept;
// y[i] = y[i] > 0 ? y[i] : exp(y[i]) - 1, in place (ELU, Clevert et al. 2016), to within one unit
// in the last place. NaN stays NaN.
void elu(std::span<float> y) noexcept;
// y[i] += a * x[i].
void add_scaled(float a, std::span<const float> x, std::span<float> y) noexcept;
// y[i] = (x[i] - mean[i]) * factor[i], clamped to [-clip, clip]. NaN stays NaN.
void standardise(std::span<const float> x, std::span<const float> mean,
                 std::span<const float> factor, float clip, std::span<float> y) noexcept;

// The sum of squares, in 16 parts: part p sums x[p], x[p + 16], ... in order, and the second half
// of the parts is added to the first until one is left.
float square_length(std::span<const float> x) noexcept;

// The plain loops that the above equal bit for bit (a NaN is a NaN; which one is not promised).
namespace scalar {
void dense(std::span<const float> x, std::span<const float> weights, std::span<const float> bias,
           std::span<float> y) noexcept;
void elu(std::span<float> y) noexcept;
void add_scaled(float a, std::span<const float> x, std::span<float> y) noexcept;
void standardise(std::span<const float> x, std::span<const float> mean,
                 std::span<const float> factor, float clip, std::span<float> y) noexcept;
float square_length(std::span<const float> x) noexcept;
}  // namespace scalar

// The sum of x in a machine-dependent order, as fast as memory allows. For measurements.
float sum_in_any_order(std::span<const float> x) noexcept;

// The instruction set that the vectorised kernels run on ("AVX2", "SSE4", ...).
const char* kernel_target();

}  // namespace panache
