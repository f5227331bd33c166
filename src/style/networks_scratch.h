#pragma once
// Shared by the sources of StyleNetworks. Private to them.

#include <cmath>
#include <span>

#include "net/dense.h"
#include "style/networks.h"

namespace panache {

// Moves a gate by `share` of the way; at 1 to the very bit, wherever it was.
inline void ease_gate(float wanted, float share, float& open) {
  open = share < 1 ? open + share * (wanted - open) : wanted;
}

// Room on the stack, handed out in parts that begin on a cache line.
class StyleNetworks::ScratchArena {
 public:
  explicit ScratchArena(std::span<float> numbers) : remaining_(numbers) {}
  std::span<float> take(size_t numbers) {
    const std::span<float> part = remaining_.first(padded(numbers));
    remaining_ = remaining_.subspan(part.size());
    return part;
  }
  // So many rows of so many numbers.
  Rows<float> rows(size_t count, size_t numbers) {
    return {take(count * padded(numbers)).data(), count, padded(numbers)};
  }
  // The memory allocated so far, to be handed out again by a copy.
  std::span<float> remaining() const { return remaining_; }

 private:
  std::span<float> remaining_;
};

}  // namespace panache
