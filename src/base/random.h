#pragma once
// Random numbers that are the same on every machine. The state is the seed.

#include <cmath>
#include <cstdint>

namespace panache {

// SplitMix64 (Steele et al. 2014).
class Random {
 public:
  explicit Random(uint64_t seed) : state_(seed * 0x9e3779b97f4a7c15u + 0x2545f4914f6cdd1du) {}

  uint64_t bits() {
    uint64_t z = (state_ += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }
  // Uniform in [0, 1).
  float uniform() { return static_cast<float>(bits() >> 40) * 0x1p-24f; }
  // Uniform in [0, count).
  uint32_t below(uint32_t count) {
    return static_cast<uint32_t>(((bits() >> 32) * uint64_t{count}) >> 32);
  }
  // Close to the standard normal distribution: the sum of four uniform numbers, within 3.5 sigma.
  float normal() {
    const uint64_t b = bits();
    const int sum =
        static_cast<int>((b & 0xffff) + ((b >> 16) & 0xffff) + ((b >> 32) & 0xffff) + (b >> 48));
    // Four uniform numbers of 16 bits: mean 2 * 65535, deviation 65536 / sqrt(3).
    return static_cast<float>(sum - 131070) * static_cast<float>(1.7320508 / 65536);
  }

 private:
  uint64_t state_;
};

}  // namespace panache
