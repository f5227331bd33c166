#include "net/dense.h"

#include <array>
#include <cassert>
#include <cstddef>
#include <utility>

#include "net/exponential.h"

// The accumulators are an array, which cannot hold vectors of a length unknown to the compiler.
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)

// From here on this file is compiled once per instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "net/dense.cpp"
#include "hwy/cache_control.h"
#include "hwy/foreach_target.h"  // IWYU pragma: keep
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace panache {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::ScalableTag<float>;
using Vector = hn::Vec<Floats>;
// Running sums in registers: enough of them hide the latency of an addition. The inputs and a
// product need registers too, of which there are 32 or 16.
#if HWY_TARGET == HWY_AVX3 || HWY_TARGET == HWY_AVX3_DL || HWY_ARCH_ARM_A64
constexpr size_t kMaxVectors = 16;  // For one row,
constexpr size_t kMaxRows = 8;      // or two for each of these.
#else
constexpr size_t kMaxVectors = 12;
constexpr size_t kMaxRows = 4;
#endif
static_assert(kMaxRows <= kRowsAtOnce);
constexpr size_t kRowVectors = 2;
// With one row the kernel is memory-bound. It prefetches weights this many numbers ahead, because
// the hardware's own prefetching comes too late.
constexpr size_t kAhead = 512;

struct Task {
  const Rows<const float>& x;
  size_t inputs;
  const float* weights;
  const float* bias;
  size_t outputs;
  const Rows<float>& y;
};

// Computes kVectors vectors of outputs from column `first` on, of kRows rows from `row` on.
template <size_t kRows, size_t kVectors>
HWY_INLINE void tile(const Task& task, size_t row, size_t first) {
  const Floats d;
  const size_t lanes = hn::Lanes(d);
  const float* HWY_RESTRICT x = task.x.row(row);
  const size_t stride = task.x.stride;
  Vector sums[kRows][kVectors];
  for (size_t v = 0; v < kVectors; ++v) {
    const Vector bias = hn::LoadU(d, task.bias + first + v * lanes);
    for (size_t r = 0; r < kRows; ++r) sums[r][v] = bias;
  }
  // Without inputs there are no weights to point at.
  const float* HWY_RESTRICT weights = task.inputs > 0 ? task.weights + first : nullptr;
  for (size_t i = 0; i < task.inputs; ++i) {
    Vector column[kVectors];
    for (size_t v = 0; v < kVectors; ++v) {
      if (kRows == 1) hwy::Prefetch(weights + v * lanes + kAhead);
      column[v] = hn::LoadU(d, weights + v * lanes);
    }
    for (size_t r = 0; r < kRows; ++r) {
      const Vector input = hn::Set(d, x[r * stride + i]);
      for (size_t v = 0; v < kVectors; ++v) {
        // No fused multiply-add: it would round once where the plain loop rounds twice.
        sums[r][v] = hn::Add(sums[r][v], hn::Mul(input, column[v]));
      }
    }
    weights += task.outputs;
  }
  for (size_t r = 0; r < kRows; ++r) {
    for (size_t v = 0; v < kVectors; ++v) {
      hn::StoreU(sums[r][v], d, task.y.row(row + r) + first + v * lanes);
    }
  }
}

using Tile = void (*)(const Task&, size_t, size_t);
// kTiles[vectors - 1] for one row.
template <size_t... k>
constexpr std::array<Tile, sizeof...(k)> one_row_tiles(std::index_sequence<k...>) {
  return {tile<1, k + 1>...};
}
// kTiles[rows - 1], each for kVectors vectors.
template <size_t kVectors, size_t... k>
constexpr std::array<Tile, sizeof...(k)> tiles_of(std::index_sequence<k...>) {
  return {tile<k + 1, kVectors>...};
}
constexpr auto kOneRow = one_row_tiles(std::make_index_sequence<kMaxVectors>());
constexpr auto kNarrowTiles = tiles_of<1>(std::make_index_sequence<kMaxRows>());
constexpr auto kWideTiles = tiles_of<kRowVectors>(std::make_index_sequence<kMaxRows>());

// Fewer outputs than lanes: one running sum in a register per output.
void few_outputs(const Task& task, size_t row) {
  const float* x = task.x.row(row);
  for (size_t o = 0; o < task.outputs; ++o) {
    float sum = task.bias[o];
    for (size_t i = 0; i < task.inputs; ++i) sum = sum + x[i] * task.weights[i * task.outputs + o];
    task.y.row(row)[o] = sum;
  }
}

// Passes of about equal width; each reads its columns of all weights once.
void one_row(const Task& task, size_t row) {
  const size_t lanes = hn::Lanes(Floats());
  size_t vectors = task.outputs / lanes;
  size_t passes = (vectors + kMaxVectors - 1) / kMaxVectors;
  for (size_t first = 0; passes > 0; --passes) {
    const size_t now = (vectors + passes - 1) / passes;
    kOneRow[now - 1](task, row, first);
    first += now * lanes;
    vectors -= now;
  }
}

void some_rows(const Task& task, size_t row, size_t rows) {
  const size_t lanes = hn::Lanes(Floats()), vectors = task.outputs / lanes;
  size_t v = 0;
  for (; v + kRowVectors <= vectors; v += kRowVectors) kWideTiles[rows - 1](task, row, v * lanes);
  for (; v < vectors; ++v) kNarrowTiles[rows - 1](task, row, v * lanes);
}

void dense_rows(const Rows<const float>& x, size_t inputs, const float* weights, const float* bias,
                size_t outputs, const Rows<float>& y) {
  const Task task{x, inputs, weights, bias, outputs, y};
  const size_t lanes = hn::Lanes(Floats());
  for (size_t row = 0; row < task.x.count;) {
    const size_t rows = HWY_MIN(task.x.count - row, kMaxRows);
    if (task.outputs < lanes) {
      for (size_t r = 0; r < rows; ++r) few_outputs(task, row + r);
    } else {
      if (rows == 1) {
        one_row(task, row);
      } else {
        some_rows(task, row, rows);
      }
      // If the outputs are not a multiple of the lanes, a last vector overlaps the one before; the
      // shared outputs are computed twice with the same bits.
      if (task.outputs % lanes != 0) kNarrowTiles[rows - 1](task, row, task.outputs - lanes);
    }
    row += rows;
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

void standardise(const float* x, const float* mean, const float* factor, float clip, float* y,
                 size_t size) {
  const Floats d;
  const size_t lanes = hn::Lanes(d);
  const Vector high = hn::Set(d, clip), low = hn::Set(d, -clip);
  size_t i = 0;
  for (; i + lanes <= size; i += lanes) {
    const Vector v =
        hn::Mul(hn::Sub(hn::LoadU(d, x + i), hn::LoadU(d, mean + i)), hn::LoadU(d, factor + i));
    const Vector above = hn::IfThenElse(hn::Lt(v, low), low, v);
    hn::StoreU(hn::IfThenElse(hn::Gt(v, high), high, above), d, y + i);
  }
  for (; i < size; ++i) {
    const float v = (x[i] - mean[i]) * factor[i];
    y[i] = v < -clip ? -clip : v > clip ? clip : v;
  }
}

float square_length(const float* x, size_t size) {
  const hn::CappedTag<float, kPadding> d;
  const size_t lanes = hn::Lanes(d);
  HWY_ALIGN float parts[kPadding] = {};
  size_t i = 0;
  for (; i + kPadding <= size; i += kPadding) {
    for (size_t p = 0; p < kPadding; p += lanes) {
      const auto v = hn::LoadU(d, x + i + p);
      hn::Store(hn::Add(hn::Load(d, parts + p), hn::Mul(v, v)), d, parts + p);
    }
  }
  for (; i < size; ++i) parts[i % kPadding] += x[i] * x[i];
  for (size_t half = kPadding / 2; half > 0; half /= 2) {
    for (size_t p = 0; p < half; ++p) parts[p] += parts[p + half];
  }
  return parts[0];
}

float sum_in_any_order(const float* x, size_t size) {
  const Floats d;
  constexpr size_t kSums = 8;
  const size_t lanes = hn::Lanes(d);
  Vector sums[kSums];
  for (Vector& sum : sums) sum = hn::Zero(d);
  size_t i = 0;
  for (; i + kSums * lanes <= size; i += kSums * lanes) {
    for (size_t k = 0; k < kSums; ++k) {
      sums[k] = hn::Add(sums[k], hn::LoadU(d, x + i + k * lanes));
    }
  }
  for (size_t k = 1; k < kSums; ++k) sums[0] = hn::Add(sums[0], sums[k]);
  float sum = hn::GetLane(hn::SumOfLanes(d, sums[0]));
  for (; i < size; ++i) sum += x[i];
  return sum;
}

const char* target_name() { return hwy::TargetName(HWY_TARGET); }

}  // namespace HWY_NAMESPACE
}  // namespace panache
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace panache {

HWY_EXPORT(dense_rows);
HWY_EXPORT(elu);
HWY_EXPORT(add_scaled);
HWY_EXPORT(standardise);
HWY_EXPORT(square_length);
HWY_EXPORT(sum_in_any_order);
HWY_EXPORT(target_name);

void dense(std::span<const float> x, std::span<const float> weights, std::span<const float> bias,
           std::span<float> y) noexcept {
  assert(bias.size() == y.size());
  dense_rows({x.data(), 1, 0}, x.size(), weights, bias, {y.data(), 1, 0});
}

void dense_rows(const Rows<const float>& x, size_t inputs, std::span<const float> weights,
                std::span<const float> bias, const Rows<float>& y) noexcept {
  assert(x.count == y.count && weights.size() == inputs * bias.size());
  HWY_DYNAMIC_DISPATCH(dense_rows)(x, inputs, weights.data(), bias.data(), bias.size(), y);
}

void elu(std::span<float> y) noexcept { HWY_DYNAMIC_DISPATCH(elu)(y.data(), y.size()); }

void add_scaled(float a, std::span<const float> x, std::span<float> y) noexcept {
  assert(x.size() == y.size());
  HWY_DYNAMIC_DISPATCH(add_scaled)(a, x.data(), y.data(), y.size());
}

void standardise(std::span<const float> x, std::span<const float> mean,
                 std::span<const float> factor, float clip, std::span<float> y) noexcept {
  assert(x.size() == y.size() && mean.size() == y.size() && factor.size() == y.size());
  HWY_DYNAMIC_DISPATCH(standardise)
  (x.data(), mean.data(), factor.data(), clip, y.data(), y.size());
}

float square_length(std::span<const float> x) noexcept {
  return HWY_DYNAMIC_DISPATCH(square_length)(x.data(), x.size());
}

float sum_in_any_order(std::span<const float> x) noexcept {
  return HWY_DYNAMIC_DISPATCH(sum_in_any_order)(x.data(), x.size());
}

const char* kernel_target() { return HWY_DYNAMIC_DISPATCH(target_name)(); }

}  // namespace panache
#endif  // HWY_ONCE
