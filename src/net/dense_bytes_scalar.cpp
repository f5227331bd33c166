// The plain loop. It defines the result, so it stands apart from the code that is compiled once per
// instruction set.
#include "net/dense_bytes.h"

#include <algorithm>
#include <cassert>

#include "net/whole_numbers.h"

namespace panache::scalar {
namespace {

using namespace whole_numbers;

uint32_t finite_size(float x) {
  const uint32_t size = std::bit_cast<uint32_t>(x) & kSizeBits;
  return size > kLargestFinite ? 0 : size;
}

int32_t rounded(float x, float reciprocal) {
  if (finite_size(x) == 0) return 0;
  return static_cast<int32_t>(std::bit_cast<uint32_t>(x * reciprocal + kRound) - kRoundBits);
}

}  // namespace

void dense_bytes(const Rows<const float>& x, const ByteMatrix& layer,
                 const Rows<float>& y) noexcept {
  assert(x.count == y.count && layer.inputs <= kMaxByteInputs);
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
