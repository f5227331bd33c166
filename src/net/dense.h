#pragma once
// The arithmetic of small dense networks. Each kernel exists twice: a plain loop, which defines the
// result, and a vectorised one, which gives the same bits on every instruction set: one lane per
// output, multiply and add apart, inputs in order, our own exponential.

#include <span>

namespace panache {

// y[o] = bias[o] + sum over i, in order, of x[i] * weights[i][o]. weights[in][out], in = x.size(),
// out = y.size() = bias.size(). No argument may overlap y.
void dense(std::span<const float> x, std::span<const float> weights, std::span<const float> bias,
           std::span<float> y) noexcept;
// y[i] = y[i] > 0 ? y[i] : exp(y[i]) - 1, in place (ELU, Clevert et al. 2016), to within one unit
// in the last place. NaN stays NaN.
void elu(std::span<float> y) noexcept;
// y[i] += a * x[i].
void add_scaled(float a, std::span<const float> x, std::span<float> y) noexcept;

// The plain loops that the above equal bit for bit (a NaN is a NaN; which one is not promised).
namespace scalar {
void dense(std::span<const float> x, std::span<const float> weights, std::span<const float> bias,
           std::span<float> y) noexcept;
void elu(std::span<float> y) noexcept;
void add_scaled(float a, std::span<const float> x, std::span<float> y) noexcept;
}  // namespace scalar

// The instruction set that the vectorised kernels run on ("AVX2", "SSE4", ...).
const char* kernel_target();

}  // namespace panache
