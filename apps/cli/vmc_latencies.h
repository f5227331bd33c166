#pragma once
// How long datagrams stay in the relay.

#include <array>
#include <cstdint>

namespace panache::cli {

// Counts microseconds, all from 10 ms on as one, and so takes the same room for any number of them.
class VmcLatencies {
 public:
  void add(double seconds);
  // The microseconds that `share` (0 to 1) of them do not exceed; 0 of none.
  int quantile_us(double share) const;
  void clear() { *this = {}; }

 private:
  static constexpr int kMax = 10'000;
  std::array<uint32_t, kMax + 1> counts_{};  // [microseconds]
  uint64_t all_ = 0;
};

}  // namespace panache::cli
