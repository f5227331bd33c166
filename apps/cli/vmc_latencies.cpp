#include "vmc_latencies.h"

#include <algorithm>
#include <cmath>

namespace panache::cli {

void VmcLatencies::add(double seconds) {
  // A clock that is set meanwhile may give any number.
  const double us = std::clamp(std::ceil(1e6 * seconds), 0.0, double{kMax});
  ++counts_[static_cast<size_t>(us)];
  ++all_;
}

int VmcLatencies::quantile_us(double share) const {
  const auto wanted = static_cast<uint64_t>(std::ceil(share * static_cast<double>(all_)));
  uint64_t sum = 0;
  for (int us = 0; us <= kMax; ++us) {
    sum += counts_[static_cast<size_t>(us)];
    if (sum >= wanted) return us;
  }
  return kMax;
}

}  // namespace panache::cli
