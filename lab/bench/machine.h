#pragma once
// What the machine can do at best, with the widest registers that it has: the limits beside which
// the speed of a network means something.

#include <string>

namespace panache::bench {

struct Limits {
  std::string processor;    // As the system calls it.
  double memory_gb_s = 0;   // Read from memory, by far more than any cache holds.
  double apart_gflops = 0;  // Multiply and add apart on numbers in registers, as our kernels do,
  double fused_gflops = 0;  // and fused where the machine can; 10^9 operations a second.
};
Limits measure_limits();

}  // namespace panache::bench
