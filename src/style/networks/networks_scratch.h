#pragma once
// Shared by the sources of StyleNetworks. Private to them.

#include <cmath>
#include <span>

#include "net/dense.h"
#include "style/networks/networks.h"

namespace panache {

// Moves a gate by `share` of the way; a share of 1 gives exactly `wanted`.
inline void ease_gate(float wanted, float share, float& open) {
  open = share < 1 ? open + share * (wanted - open) : wanted;
}

// An arena on the stack; allocations are aligned to cache lines.
class StyleNetworks::ScratchArena {
 public:
  explicit ScratchArena(std::span<float> numbers) : remaining_(numbers) {}
  std::span<float> take(size_t numbers) {
    const std::span<float> part = remaining_.first(padded(numbers));
    remaining_ = remaining_.subspan(part.size());
    return part;
  }
  // `count` rows of `numbers` floats.
  Rows<float> rows(size_t count, size_t numbers) {
    return {take(count * padded(numbers)).data(), count, padded(numbers)};
  }
  // The remaining memory, for a nested arena.
  std::span<float> remaining() const { return remaining_; }

 private:
  std::span<float> remaining_;
};

}  // namespace panache
