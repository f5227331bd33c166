#include "net/dense_int8.h"

#include <array>
#include <cassert>
#include <cstring>
#include <utility>

#include "net/int8_rounding.h"
#include "net/rows.h"

// The sums are an array, which cannot hold vectors of a length unknown to the compiler.
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)

// From here on this file is compiled once per instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "net/dense_int8.cpp"
#include "hwy/foreach_target.h"  // IWYU pragma: keep
#include "hwy/cache_control.h"
#include "hwy/highway.h"

#if HWY_TARGET == HWY_AVX3_DL
// Highway checks for this extension, but does not enable it in the compiler.
HWY_PUSH_ATTRIBUTES(HWY_TARGET_STR ",avx512vnni")
#else
HWY_BEFORE_NAMESPACE();
#endif
namespace panache {
namespace HWY_NAMESPACE {
#if HWY_TARGET == HWY_SCALAR

// Machines without vectors use the plain loop.
void dense_int8(const Rows<const float>& x, const Int8Matrix& layer, const Rows<float>& y) {
  scalar::dense_int8(x, layer, y);
}

#else

#if defined(__clang__)
#define PANACHE_UNROLL _Pragma("unroll")
#else
#define PANACHE_UNROLL _Pragma("GCC unroll 16")
#endif
namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::ScalableTag<float>;
using Wholes = hn::ScalableTag<int32_t>;          // As many lanes as floats.
using Shorts = hn::Repartition<int16_t, Wholes>;  // Twice as many.
using FewShorts = hn::Rebind<int16_t, Wholes>;    // As many lanes as floats.
using Sums = hn::Vec<Wholes>;

// Vectors of weights in a tile of one row, each with two vectors of sums. See dense.cpp; here the
// weights of a tile need registers too.
#if HWY_TARGET == HWY_AVX3 || HWY_TARGET == HWY_AVX3_DL || HWY_ARCH_ARM_A64
constexpr size_t kMaxVectors = 8, kMaxRows = 8;
#else
constexpr size_t kMaxVectors = 6, kMaxRows = 4;
#endif
static_assert(kMaxRows <= kRowsAtOnce);
// A rounded row of inputs, with room for whole vectors.
constexpr size_t kRowRoom = kMaxInt8Inputs + kPadding;

// How far ahead weights are prefetched in a tile of one row: 2 KB.
constexpr size_t kAhead = 1024;
constexpr size_t kVectorsInLine =
    HWY_MAX(kCacheLine / (sizeof(int16_t) * hn::MaxLanes(Shorts())), size_t{1});

using Rounded = int16_t[kMaxRows][kRowRoom];

struct RoundedRow {
  float step;
  int32_t sum;  // Of the rounded numbers.
};
// Rounds a row to integer steps.
RoundedRow round_row(const float* x, size_t inputs, int16_t* out) {
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

  Sums sum = hn::Zero(di);
  const auto round = [&](hn::Vec<Floats> v, int16_t* to) {
    const auto nothing = hn::Gt(size_bits(v), hn::Set(di, int32_t{kLargestFinite}));
    const hn::Vec<Floats> shifted =
        hn::Add(hn::Mul(v, hn::Set(d, step.reciprocal)), hn::Set(d, kRound));
    const Sums n = hn::IfThenZeroElse(
        nothing, hn::Sub(hn::BitCast(di, shifted), hn::Set(di, int32_t{kRoundBits})));
    sum = hn::Add(sum, n);
    hn::StoreU(hn::DemoteTo(FewShorts(), n), FewShorts(), to);
  };
  for (size_t i = 0; i < whole; i += lanes) round(hn::LoadU(d, x + i), out + i);
  round(hn::Load(d, rest), out + whole);
  return {step.size, hn::GetLane(hn::SumOfLanes(di, sum))};
}

// Keeps GCC 12 from loading weights twice, and from copying sums to other registers and to memory.
template <class V>
HWY_INLINE void keep([[maybe_unused]] V& v) {
#if HWY_ARCH_X86 && HWY_COMPILER_GCC_ACTUAL
  __asm__("" : "+v"(v.raw));
#endif
}

// Adds the products of neighbours; `other` takes what does not go into `sums` on some instruction
// sets.
HWY_INLINE void add_pairs(hn::Vec<Shorts> a, hn::Vec<Shorts> b, Sums& sums,
                          [[maybe_unused]] Sums& other) {
#if HWY_TARGET == HWY_AVX3_DL && HWY_COMPILER_GCC_ACTUAL
  // Not with the intrinsic: GCC 12 would copy each sum to another register and back.
  __asm__("vpdpwssd %2, %1, %0" : "+v"(sums.raw) : "v"(a.raw), "v"(b.raw));
#elif HWY_TARGET == HWY_AVX3_DL
  sums.raw = _mm512_dpwssd_epi32(sums.raw, a.raw, b.raw);
#else
  sums = hn::ReorderWidenMulAccumulate(Wholes(), a, b, sums, other);
  keep(sums);
#endif
}

struct Int8Task {
  const Int8Matrix* layer;
  const Rounded* x;
  const RoundedRow* rows;
  Rows<float> y;
};

// The vectors of outputs from both halves of their pairs. If a vector holds the pairs of two
// blocks, each result is a block; otherwise the second is half a block further.
constexpr bool kTwoBlocks = hn::MaxLanes(Wholes()) > kBlockPairs;
static_assert(hn::MaxLanes(Wholes()) <= 2 * kBlockPairs);
constexpr size_t kSecond = kTwoBlocks ? kPadding : kBlockPairs;
HWY_INLINE Sums first_outputs(Sums low, Sums high) {
  if constexpr (kTwoBlocks) return hn::ConcatLowerLower(Wholes(), high, low);
  return low;
}
HWY_INLINE Sums second_outputs(Sums low, Sums high) {
  if constexpr (kTwoBlocks) return hn::ConcatUpperUpper(Wholes(), high, low);
  return high;
}

// Computes kVectors vectors of output pairs, from pair `first` on, for all kRows rows.
template <size_t kRows, size_t kVectors>
HWY_INLINE void int8_tile(const Int8Task& task, size_t first) {
  const Floats d;
  const Wholes di;
  const Shorts ds;
  const size_t lanes = hn::Lanes(di);
  const Int8Matrix layer = *task.layer;
  // Sums for whole numbers of two weights, and for the upper weights alone.
  Sums both[kRows][kVectors], others[kRows][kVectors];
  Sums high[kRows][kVectors], high_others[kRows][kVectors];
  PANACHE_UNROLL
  for (size_t r = 0; r < kRows; ++r) {
    PANACHE_UNROLL
    for (size_t v = 0; v < kVectors; ++v) {
      both[r][v] = others[r][v] = high[r][v] = high_others[r][v] = hn::Zero(di);
    }
  }
  // Without inputs there are no weights to point at.
  const int16_t* HWY_RESTRICT weights = layer.inputs > 0 ? layer.weights + 2 * first : nullptr;
  for (size_t i = 0; i < layer.inputs; i += 2) {
    hn::Vec<Shorts> inputs[kRows];
    PANACHE_UNROLL
    for (size_t r = 0; r < kRows; ++r) {
      int32_t pair;
      std::memcpy(&pair, &(*task.x)[r][i], sizeof pair);
      inputs[r] = hn::BitCast(ds, hn::Set(di, pair));
    }
    PANACHE_UNROLL
    for (size_t v = 0; v < kVectors; ++v) {
      hn::Vec<Shorts> packed = hn::LoadU(ds, weights + v * 2 * lanes);
      keep(packed);
      if (kRows == 1 && v % kVectorsInLine == 0) {
        hwy::Prefetch(weights + v * 2 * lanes + kAhead);
      }
      PANACHE_UNROLL
      for (size_t r = 0; r < kRows; ++r) add_pairs(packed, inputs[r], both[r][v], others[r][v]);
      packed = hn::ShiftRight<8>(packed);
      keep(packed);
      PANACHE_UNROLL
      for (size_t r = 0; r < kRows; ++r) {
        add_pairs(packed, inputs[r], high[r][v], high_others[r][v]);
      }
    }
    weights += layer.outputs;
  }
  // Takes a block that the last vector has and the layer lacks.
  HWY_ALIGN float none[hn::MaxLanes(d)];
  PANACHE_UNROLL
  for (size_t v = 0; v < kVectors; ++v) {
    const size_t pair = first + v * lanes;
    const size_t at = pair / kBlockPairs * kPadding + pair % kBlockPairs;
    const bool has_second = at + kSecond < layer.outputs;
    const size_t second = has_second ? at + kSecond : at;
    const hn::Vec<Floats> first_scale = hn::LoadU(d, layer.scale + at);
    const hn::Vec<Floats> second_scale = hn::LoadU(d, layer.scale + second);
    const hn::Vec<Floats> first_bias = hn::LoadU(d, layer.bias + at);
    const hn::Vec<Floats> second_bias = hn::LoadU(d, layer.bias + second);
    PANACHE_UNROLL
    for (size_t r = 0; r < kRows; ++r) {
      const RoundedRow& rounded = task.rows[r];
      float* row = task.y.row(r);
      // What the offset of the lower weights added to their sums.
      const uint32_t offset = kLowWeightOffset * static_cast<uint32_t>(rounded.sum);
      const Sums upper = hn::RearrangeToOddPlusEven(high[r][v], high_others[r][v]);
      const Sums whole = hn::RearrangeToOddPlusEven(both[r][v], others[r][v]);
      const Sums lower = hn::Sub(hn::Sub(whole, hn::ShiftLeft<8>(upper)),
                                 hn::Set(di, static_cast<int32_t>(offset)));
      const hn::Vec<Floats> step = hn::Set(d, rounded.step);
      const hn::Vec<Floats> a = hn::ConvertTo(d, first_outputs(lower, upper));
      const hn::Vec<Floats> b = hn::ConvertTo(d, second_outputs(lower, upper));
      hn::StoreU(hn::Add(first_bias, hn::Mul(hn::Mul(step, first_scale), a)), d, row + at);
      hn::StoreU(hn::Add(second_bias, hn::Mul(hn::Mul(step, second_scale), b)), d,
                 has_second ? row + second : none);
    }
  }
}

using Int8Tile = void (*)(const Int8Task&, size_t);
// [vectors - 1], for one row.
template <size_t... k>
constexpr std::array<Int8Tile, sizeof...(k)> one_row_int8_tiles(std::index_sequence<k...>) {
  return {int8_tile<1, k + 1>...};
}
// [rows - 1], for one vector.
template <size_t... k>
constexpr std::array<Int8Tile, sizeof...(k)> one_vector_int8_tiles(std::index_sequence<k...>) {
  return {int8_tile<k + 1, 1>...};
}
constexpr auto kOneRow = one_row_int8_tiles(std::make_index_sequence<kMaxVectors>());
constexpr auto kOneVector = one_vector_int8_tiles(std::make_index_sequence<kMaxRows>());

void dense_int8(const Rows<const float>& x, const Int8Matrix& layer, const Rows<float>& y) {
  const size_t lanes = hn::Lanes(Wholes());
  HWY_ALIGN Rounded rounded;
  RoundedRow about[kMaxRows];
  for (size_t row = 0; row < x.count;) {
    const size_t rows = HWY_MIN(x.count - row, kMaxRows);
    for (size_t r = 0; r < rows; ++r) {
      about[r] = round_row(x.row(row + r), layer.inputs, rounded[r]);
      if (layer.inputs % 2 != 0) rounded[r][layer.inputs] = 0;
    }
    const Int8Task task{&layer, &rounded, about, {y.row(row), rows, y.stride}};
    size_t vectors = (layer.outputs / 2 + lanes - 1) / lanes, first = 0;
    if (rows == 1) {
      // Passes of about equal width; each reads its columns of all weights once.
      for (size_t passes = (vectors + kMaxVectors - 1) / kMaxVectors; passes > 0; --passes) {
        const size_t now = (vectors + passes - 1) / passes;
        kOneRow[now - 1](task, first);
        first += now * lanes;
        vectors -= now;
      }
    } else {
      for (; vectors > 0; --vectors, first += lanes) kOneVector[rows - 1](task, first);
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
