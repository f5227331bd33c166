// The plain loop. It defines the result, so it stands apart from the code that is compiled once per
// instruction set.
#include "net/dense_int8.h"

#include <algorithm>
#include <cassert>

#include "net/int8_rounding.h"

namespace panache::scalar {
namespace {

using namespace int8_rounding;

uint32_t finite_size(float x) {
  const uint32_t size = std::bit_cast<uint32_t>(x) & kSizeBits;
  return size > kLargestFinite ? 0 : size;
}

int32_t rounded(float x, float reciprocal) {
  if (finite_size(x) == 0) return 0;
  return static_cast<int32_t>(std::bit_cast<uint32_t>(x * reciprocal + kRound) - kRoundBits);
}

}  // namespace

void dense_int8(const Rows<const float>& x, const Int8Matrix& layer,
                const Rows<float>& y) noexcept {
  assert(x.count == y.count && layer.inputs <= kMaxInt8Inputs);
  for (size_t r = 0; r < x.count; ++r) {
    uint32_t largest = 0;
    for (size_t i = 0; i < layer.inputs; ++i) largest = std::max(largest, finite_size(x.row(r)[i]));
    const Step step = step_for(largest);
    for (size_t o = 0; o < layer.outputs; ++o) {
      int32_t sum = 0;
      for (size_t i = 0; i < layer.inputs; ++i) {
        const int32_t weight = layer.weights[(i / 2 * layer.outputs + o) * 2 + i % 2];
        sum += rounded(x.row(r)[i], step.reciprocal) * weight;
      }
      y.row(r)[o] = layer.bias[o] + (step.size * layer.scale[o]) * static_cast<float>(sum);
    }
  }
}

}  // namespace panache::scalar
