#pragma once
// One line of the report, for a system or for real motion: the value of each measure.

#include <cstddef>
#include <limits>
#include <map>
#include <string>
#include <string_view>

namespace panache {

inline constexpr double kNotMeasured = std::numeric_limits<double>::quiet_NaN();

// Means over takes of each style and content, then over styles and contents, by the measures' keys
// (see eval/measure.h); NaN if not measured.
class Metrics {
 public:
  size_t takes = 0, windows = 0;

  double operator[](std::string_view key) const {
    const auto found = values_.find(key);
    return found == values_.end() ? kNotMeasured : found->second;
  }
  double& operator[](std::string_view key) {
    return values_.try_emplace(std::string(key), kNotMeasured).first->second;
  }

 private:
  std::map<std::string, double, std::less<>> values_;
};

using MetricsTable = std::map<std::string, Metrics>;  // By content, style or strength.

}  // namespace panache
