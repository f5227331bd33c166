#pragma once
// The peak performance of the machine with its widest registers, to compare network speed with.

#include <string>

namespace panache::bench {

struct Limits {
  std::string processor;    // Name given by the system.
  double memory_gb_s = 0;   // Reading far more memory than any cache holds.
  double apart_gflops = 0;  // Separate multiply and add in registers, as our kernels do,
  double fused_gflops = 0;  // and fused if the machine can; 10^9 operations a second.
};
Limits measure_limits();

}  // namespace panache::bench
