#pragma once
// Formats and averages the numbers of a report.

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "eval/measure.h"

namespace panache {

inline constexpr const char* kDash = "\xe2\x80\x93";  // For missing values.

// `value` with so many decimals in any locale; a dash if it is not finite.
std::string number_text(double value, int digits);

// "1,234,567"; a dash for 0.
std::string count_text(size_t count);

// The quantile `at`, 0 to 1, of the finite `values`, interpolated linearly; NaN if there are none.
double quantile(std::vector<double> values, double at);

// The mean of the finite values; NaN if there are none.
double finite_mean(const std::vector<double>& values);

// The mean of each number over the lines that have it; takes and windows are summed.
Metrics mean_metrics(const std::vector<const Metrics*>& lines);
template <class Key>
Metrics mean_metrics(const std::map<Key, Metrics>& table) {
  std::vector<const Metrics*> lines;
  for (const auto& [name, metrics] : table) lines.push_back(&metrics);
  return mean_metrics(lines);
}
}  // namespace panache
