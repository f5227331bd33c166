#include "net/dense.h"

#include <cassert>
#include <cstddef>

#include "net/exponential.h"

// The accumulators live in an array, which vectors of a length unknown to the compiler cannot.
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)

// From here on this file is compiled once per instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "net/dense.cpp"
#include "hwy/foreach_target.h"  // IWYU pragma: keep
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace panache {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::ScalableTag<float>;
using Vector = hn::Vec<Floats>;
// Enough running sums to hide the latency of an addition; more would not fit into 16 registers
// together with the input and the product.
constexpr size_t kMaxVectors = 12;

// Computes kVectors vectors of outputs from column `first` on. The last of them starts at `last`:
// where the outputs are no multiple of the lanes it overlaps the one before, and the outputs in
// common are computed twice with the same bits.
template <size_t kVectors>
HWY_INLINE void columns(const float* HWY_RESTRICT x, size_t inputs,
                        const float* HWY_RESTRICT weights, const float* HWY_RESTRICT bias,
                        float* HWY_RESTRICT y, size_t outputs, size_t first, size_t last) {
  const Floats d;
  const size_t lanes = hn::Lanes(d);
  Vector sums[kVectors];
  for (size_t v = 0; v + 1 < kVectors; ++v) sums[v] = hn::LoadU(d, bias + first + v * lanes);
  sums[kVectors - 1] = hn::LoadU(d, bias + last);
  for (size_t i = 0; i < inputs; ++i) {
    const Vector input = hn::Set(d, x[i]);
    const float* row = weights + i * outputs;
    for (size_t v = 0; v + 1 < kVectors; ++v) {
      // Multiplied and added apart: a fused step would round once where others round twice.
      sums[v] = hn::Add(sums[v], hn::Mul(input, hn::LoadU(d, row + first + v * lanes)));
    }
    sums[kVectors - 1] = hn::Add(sums[kVectors - 1], hn::Mul(input, hn::LoadU(d, row + last)));
  }
  for (size_t v = 0; v + 1 < kVectors; ++v) hn::StoreU(sums[v], d, y + first + v * lanes);
  hn::StoreU(sums[kVectors - 1], d, y + last);
}

using Columns = void (*)(const float*, size_t, const float*, const float*, float*, size_t, size_t,
                         size_t);
constexpr Columns kColumns[kMaxVectors + 1] = {
    nullptr,    columns<1>, columns<2>, columns<3>,  columns<4>,  columns<5>, columns<6>,
    columns<7>, columns<8>, columns<9>, columns<10>, columns<11>, columns<12>};

// Fewer outputs than lanes: one running sum in a register per output.
void few_outputs(const float* x, size_t inputs, const float* weights, const float* bias, float* y,
                 size_t outputs) {
  for (size_t o = 0; o < outputs; ++o) {
    float sum = bias[o];
    for (size_t i = 0; i < inputs; ++i) sum = sum + x[i] * weights[i * outputs + o];
    y[o] = sum;
  }
}

void dense(const float* x, size_t inputs, const float* weights, const float* bias, float* y,
           size_t outputs) {
  const size_t lanes = hn::Lanes(Floats());
  if (outputs < lanes) return few_outputs(x, inputs, weights, bias, y, outputs);
  // Passes of about equal width; each reads its columns of all weights once.
  size_t vectors = (outputs + lanes - 1) / lanes;
  size_t passes = (vectors + kMaxVectors - 1) / kMaxVectors;
  for (size_t first = 0; passes > 0; --passes) {
    const size_t now = (vectors + passes - 1) / passes;
    const size_t next = first + now * lanes;
    const size_t last = (next < outputs ? next : outputs) - lanes;
    kColumns[now](x, inputs, weights, bias, y, outputs, first, last);
    first = next;
    vectors -= now;
  }
}

// Each line is one operation of the plain loop.
HWY_INLINE Vector elu_of(Vector y) {
  using namespace exponential;
  const Floats d;
  const hn::RebindToUnsigned<Floats> du;
  const Vector lowest = hn::Set(d, kLowest), round = hn::Set(d, kRound), one = hn::Set(d, 1.0f);
  const Vector x = hn::IfThenElse(hn::Lt(y, lowest), lowest, y);
  const Vector shifted = hn::Add(hn::Mul(x, hn::Set(d, kLog2E)), round);
  const Vector n = hn::Sub(shifted, round);
  const Vector r =
      hn::Sub(hn::Sub(x, hn::Mul(n, hn::Set(d, kLn2High))), hn::Mul(n, hn::Set(d, kLn2Low)));
  Vector series = hn::Set(d, kSeries[5]);
  for (int k = 4; k >= 0; --k) series = hn::Add(hn::Mul(series, r), hn::Set(d, kSeries[k]));
  const Vector power = hn::Add(r, hn::Mul(hn::Mul(r, r), series));
  const auto exponent = hn::ShiftLeft<kMantissaBits>(hn::BitCast(du, shifted));
  const Vector scale = hn::BitCast(d, hn::Add(exponent, hn::Set(du, kOneBits)));
  const Vector below = hn::Add(hn::Mul(scale, power), hn::Sub(scale, one));
  return hn::IfThenElse(hn::Gt(y, hn::Zero(d)), y, below);
}

void elu(float* y, size_t size) {
  const Floats d;
  const size_t lanes = hn::Lanes(d);
  size_t i = 0;
  for (; i + lanes <= size; i += lanes) hn::StoreU(elu_of(hn::LoadU(d, y + i)), d, y + i);
  if (i == size) return;
  HWY_ALIGN float rest[hn::MaxLanes(d)] = {};
  for (size_t k = i; k < size; ++k) rest[k - i] = y[k];
  hn::Store(elu_of(hn::Load(d, rest)), d, rest);
  for (size_t k = i; k < size; ++k) y[k] = rest[k - i];
}

void add_scaled(float a, const float* HWY_RESTRICT x, float* HWY_RESTRICT y, size_t size) {
  const Floats d;
  const size_t lanes = hn::Lanes(d);
  const Vector factor = hn::Set(d, a);
  size_t i = 0;
  for (; i + lanes <= size; i += lanes) {
    hn::StoreU(hn::Add(hn::LoadU(d, y + i), hn::Mul(factor, hn::LoadU(d, x + i))), d, y + i);
  }
  for (; i < size; ++i) y[i] = y[i] + a * x[i];
}

const char* target_name() { return hwy::TargetName(HWY_TARGET); }

}  // namespace HWY_NAMESPACE
}  // namespace panache
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace panache {

HWY_EXPORT(dense);
HWY_EXPORT(elu);
HWY_EXPORT(add_scaled);
HWY_EXPORT(target_name);

void dense(std::span<const float> x, std::span<const float> weights, std::span<const float> bias,
           std::span<float> y) noexcept {
  assert(bias.size() == y.size() && weights.size() == x.size() * y.size());
  HWY_DYNAMIC_DISPATCH(dense)
  (x.data(), x.size(), weights.data(), bias.data(), y.data(), y.size());
}

void elu(std::span<float> y) noexcept { HWY_DYNAMIC_DISPATCH(elu)(y.data(), y.size()); }

void add_scaled(float a, std::span<const float> x, std::span<float> y) noexcept {
  assert(x.size() == y.size());
  HWY_DYNAMIC_DISPATCH(add_scaled)(a, x.data(), y.data(), y.size());
}

const char* kernel_target() { return HWY_DYNAMIC_DISPATCH(target_name)(); }

}  // namespace panache
#endif  // HWY_ONCE
