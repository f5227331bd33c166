#include "net/dense_int8.h"

#include <array>
#include <cassert>
#include <cstring>
#include <utility>

#include "net/int8_rounding.h"

// The sums live in an array, which vectors of a length unknown to the compiler cannot.
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)

// From here on this file is compiled once per instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "net/dense_int8.cpp"
#include "hwy/foreach_target.h"  // IWYU pragma: keep
#include "hwy/highway.h"

#if HWY_TARGET == HWY_AVX3_DL
// Highway asks the processor for this extension, but leaves it out of what it tells the compiler.
HWY_PUSH_ATTRIBUTES(HWY_TARGET_STR ",avx512vnni")
#else
HWY_BEFORE_NAMESPACE();
#endif
namespace panache {
namespace HWY_NAMESPACE {
#if HWY_TARGET == HWY_SCALAR

// A machine without vectors has the plain loop.
void dense_int8(const Rows<const float>& x, const Int8Matrix& layer, const Rows<float>& y) {
  scalar::dense_int8(x, layer, y);
}

#else

namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::ScalableTag<float>;
using Wholes = hn::ScalableTag<int32_t>;          // As many as floats.
using Shorts = hn::Repartition<int16_t, Wholes>;  // Twice as many,
using Bytes = hn::Rebind<int8_t, Shorts>;         // and as many bytes.
using FewShorts = hn::Rebind<int16_t, Wholes>;    // As many as floats.
using Sums = hn::Vec<Wholes>;

// As in dense.cpp; here the weights of a tile take registers too.
#if HWY_TARGET == HWY_AVX3 || HWY_TARGET == HWY_AVX3_DL || HWY_ARCH_ARM_A64
constexpr size_t kMaxVectors = 16, kMaxRows = 8;
#else
constexpr size_t kMaxVectors = 8, kMaxRows = 4;
#endif
static_assert(kMaxRows <= kRowsAtOnce);
constexpr size_t kRowVectors = 2;
// Inputs of a row, rounded, with room for whole vectors.
constexpr size_t kRowRoom = kMaxInt8Inputs + kPadding;

using Rounded = int16_t[kMaxRows][kRowRoom];

// Rounds a row to whole steps, and returns the step.
float round_row(const float* x, size_t inputs, int16_t* out) {
  using namespace int8_rounding;
  const Floats d;
  const Wholes di;
  const size_t lanes = hn::Lanes(d);
  const size_t whole = inputs / lanes * lanes;
  HWY_ALIGN float rest[hn::MaxLanes(d)] = {};
  for (size_t i = whole; i < inputs; ++i) rest[i - whole] = x[i];
  const auto size_bits = [&](hn::Vec<Floats> v) {
    return hn::And(hn::BitCast(di, v), hn::Set(di, int32_t{kSizeBits}));
  };
  const auto finite_size = [&](hn::Vec<Floats> v) {
    const Sums size = size_bits(v);
    return hn::IfThenZeroElse(hn::Gt(size, hn::Set(di, int32_t{kLargestFinite})), size);
  };
  Sums sizes = finite_size(hn::Load(d, rest));
  for (size_t i = 0; i < whole; i += lanes) {
    sizes = hn::Max(sizes, finite_size(hn::LoadU(d, x + i)));
  }
  const Step step = step_for(static_cast<uint32_t>(hn::GetLane(hn::MaxOfLanes(di, sizes))));

  const auto rounded = [&](hn::Vec<Floats> v) {
    const auto nothing = hn::Gt(size_bits(v), hn::Set(di, int32_t{kLargestFinite}));
    const hn::Vec<Floats> shifted =
        hn::Add(hn::Mul(v, hn::Set(d, step.reciprocal)), hn::Set(d, kRound));
    const Sums n = hn::Sub(hn::BitCast(di, shifted), hn::Set(di, int32_t{kRoundBits}));
    return hn::DemoteTo(FewShorts(), hn::IfThenZeroElse(nothing, n));
  };
  for (size_t i = 0; i < whole; i += lanes) {
    hn::StoreU(rounded(hn::LoadU(d, x + i)), FewShorts(), out + i);
  }
  hn::StoreU(rounded(hn::Load(d, rest)), FewShorts(), out + whole);
  return step.size;
}

// Adds the products of neighbours; `other` holds what has no place in `sums`, where an instruction
// set has it so.
HWY_INLINE Sums add_pairs(hn::Vec<Shorts> a, hn::Vec<Shorts> b, Sums sums, Sums& other) {
#if HWY_TARGET == HWY_AVX3_DL
  (void)other;
  // Not by the intrinsic, with which GCC 12 copies each sum to another register and back.
  __asm__("vpdpwssd %2, %1, %0" : "+v"(sums.raw) : "v"(a.raw), "v"(b.raw));
  return sums;
#else
  return hn::ReorderWidenMulAccumulate(Wholes(), a, b, sums, other);
#endif
}

struct ByteTask {
  const Int8Matrix* layer;
  Rows<float> y;
  const Rounded* x;
  const float* steps;  // Of each row.
};

// Computes kVectors vectors of outputs from column `first` on, of all kRows rows.
template <size_t kRows, size_t kVectors>
HWY_INLINE void byte_tile(const ByteTask& task, size_t first) {
  const Floats d;
  const Wholes di;
  const Shorts ds;
  const size_t lanes = hn::Lanes(d);
  const Int8Matrix& layer = *task.layer;
  Sums sums[kRows][kVectors], others[kRows][kVectors];
  for (size_t r = 0; r < kRows; ++r) {
    for (size_t v = 0; v < kVectors; ++v) sums[r][v] = others[r][v] = hn::Zero(di);
  }
  // Without inputs there are no weights to point at.
  const int8_t* HWY_RESTRICT weights = layer.inputs > 0 ? layer.weights + 2 * first : nullptr;
  for (size_t i = 0; i < layer.inputs; i += 2) {
    hn::Vec<Shorts> column[kVectors];
    for (size_t v = 0; v < kVectors; ++v) {
      column[v] = hn::PromoteTo(ds, hn::LoadU(Bytes(), weights + v * 2 * lanes));
    }
    for (size_t r = 0; r < kRows; ++r) {
      int32_t pair;
      std::memcpy(&pair, &(*task.x)[r][i], sizeof pair);
      const hn::Vec<Shorts> input = hn::BitCast(ds, hn::Set(di, pair));
      for (size_t v = 0; v < kVectors; ++v) {
        sums[r][v] = add_pairs(column[v], input, sums[r][v], others[r][v]);
      }
    }
    weights += 2 * layer.outputs;
  }
  for (size_t v = 0; v < kVectors; ++v) {
    const size_t at = first + v * lanes;
    const hn::Vec<Floats> bias = hn::LoadU(d, layer.bias + at);
    const hn::Vec<Floats> scale = hn::LoadU(d, layer.scale + at);
    for (size_t r = 0; r < kRows; ++r) {
      const Sums sum = hn::RearrangeToOddPlusEven(sums[r][v], others[r][v]);
      const hn::Vec<Floats> unit = hn::Mul(hn::Set(d, task.steps[r]), scale);
      hn::StoreU(hn::Add(bias, hn::Mul(unit, hn::ConvertTo(d, sum))), d, task.y.row(r) + at);
    }
  }
}

using ByteTile = void (*)(const ByteTask&, size_t);
// kOneRow[vectors - 1].
template <size_t... k>
constexpr std::array<ByteTile, sizeof...(k)> one_row_int8_tiles(std::index_sequence<k...>) {
  return {byte_tile<1, k + 1>...};
}
// [rows - 1], of so many vectors each.
template <size_t kVectors, size_t... k>
constexpr std::array<ByteTile, sizeof...(k)> int8_tiles_of(std::index_sequence<k...>) {
  return {byte_tile<k + 1, kVectors>...};
}
constexpr auto kOneRow = one_row_int8_tiles(std::make_index_sequence<kMaxVectors>());
constexpr auto kNarrow = int8_tiles_of<1>(std::make_index_sequence<kMaxRows>());
constexpr auto kWide = int8_tiles_of<kRowVectors>(std::make_index_sequence<kMaxRows>());

void dense_int8(const Rows<const float>& x, const Int8Matrix& layer, const Rows<float>& y) {
  const size_t lanes = hn::Lanes(Floats());
  HWY_ALIGN Rounded rounded;
  float steps[kMaxRows];
  for (size_t row = 0; row < x.count;) {
    const size_t rows = HWY_MIN(x.count - row, kMaxRows);
    for (size_t r = 0; r < rows; ++r) {
      steps[r] = round_row(x.row(row + r), layer.inputs, rounded[r]);
      if (layer.inputs % 2 != 0) rounded[r][layer.inputs] = 0;
    }
    const ByteTask task{&layer, {y.row(row), rows, y.stride}, &rounded, steps};
    size_t vectors = layer.outputs / lanes, first = 0;
    if (rows == 1) {
      // Passes of about equal width; each reads its columns of all weights once.
      for (size_t passes = (vectors + kMaxVectors - 1) / kMaxVectors; passes > 0; --passes) {
        const size_t now = (vectors + passes - 1) / passes;
        kOneRow[now - 1](task, first);
        first += now * lanes;
        vectors -= now;
      }
    } else {
      for (; vectors >= kRowVectors; vectors -= kRowVectors, first += kRowVectors * lanes) {
        kWide[rows - 1](task, first);
      }
      for (; vectors > 0; --vectors, first += lanes) kNarrow[rows - 1](task, first);
    }
    row += rows;
  }
}

#endif  // HWY_SCALAR

}  // namespace HWY_NAMESPACE
}  // namespace panache
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace panache {

HWY_EXPORT(dense_int8);

void dense_int8(const Rows<const float>& x, const Int8Matrix& layer,
                const Rows<float>& y) noexcept {
  assert(x.count == y.count && layer.inputs <= kMaxInt8Inputs && layer.outputs % kPadding == 0);
  HWY_DYNAMIC_DISPATCH(dense_int8)(x, layer, y);
}

}  // namespace panache
#endif  // HWY_ONCE
