#pragma once
// Numbers of a report as people read them.

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "eval/measure.h"

namespace panache {

inline constexpr const char* kDash = "\xe2\x80\x93";  // Stands where nothing was measured.

// `value` with so many decimals, whatever the locale; a dash for what is not finite.
std::string number_text(double value, int digits);

// "1,234,567"; a dash for 0.
std::string count_text(size_t count);

// The value below which the share `at`, 0 to 1, of the finite `values` lie, interpolated between
// neighbours; NaN of none.
double quantile(std::vector<double> values, double at);

// The mean of those that are finite; NaN of none.
double finite_mean(const std::vector<double>& values);

// The mean of each number over the lines where it was measured; takes and windows add up.
Metrics mean_metrics(const std::vector<const Metrics*>& lines);
template <class Key>
Metrics mean_metrics(const std::map<Key, Metrics>& table) {
  std::vector<const Metrics*> lines;
  for (const auto& [name, metrics] : table) lines.push_back(&metrics);
  return mean_metrics(lines);
}

// How many columns of a terminal `text`, UTF-8, takes.
size_t column_count(std::string_view text);

}  // namespace panache
