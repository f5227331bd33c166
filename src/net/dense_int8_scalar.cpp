// The plain loop. It defines the result, so it stands apart from the code that is compiled once per
// instruction set.
#include "net/dense_int8.h"

#include <algorithm>
#include <cassert>

#include "net/int8_rounding.h"

namespace panache {
namespace {

// The index of a weight among the packed ones.
size_t packed_index(size_t outputs, size_t input, size_t output) {
  const size_t pair = output / kPadding * kBlockPairs + output % kBlockPairs;
  return (input / 2 * (outputs / 2) + pair) * 2 + input % 2;
}
bool is_high(size_t output) { return output % kPadding >= kBlockPairs; }

}  // namespace

int8_t int8_weight(const int16_t* weights, size_t outputs, size_t input, size_t output) {
  const int16_t packed = weights[packed_index(outputs, input, output)];
  return is_high(output) ? high_weight(packed) : low_weight(packed);
}

void set_int8_weight(int16_t* weights, size_t outputs, size_t input, size_t output, int8_t weight) {
  int16_t& packed = weights[packed_index(outputs, input, output)];
  packed = is_high(output) ? packed_weights(low_weight(packed), weight)
                           : packed_weights(weight, high_weight(packed));
}

namespace scalar {
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
        const int32_t weight = int8_weight(layer.weights, layer.outputs, i, o);
        sum += rounded(x.row(r)[i], step.reciprocal) * weight;
      }
      y.row(r)[o] = layer.bias[o] + (step.size * layer.scale[o]) * static_cast<float>(sum);
    }
  }
}

}  // namespace scalar
}  // namespace panache
