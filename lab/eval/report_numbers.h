#pragma once
// Numbers of a report as people read them.

#include <string>
#include <string_view>
#include <vector>

#include "eval/measure.h"

namespace panache {

inline constexpr const char* kDash = "\xe2\x80\x93";  // Stands where nothing was measured.

// `value` with so many decimals, whatever the locale; a dash for what is not finite.
std::string number_text(double value, int digits);

// "848 KB"; a dash for 0.
std::string bytes_text(size_t bytes);

// "1,234,567"; a dash for 0.
std::string count_text(size_t count);

// The value below which the share `at`, 0 to 1, of the finite `values` lie, interpolated between
// neighbours; NaN of none.
double quantile(std::vector<double> values, double at);

// The mean of those that are finite; NaN of none.
double finite_mean(const std::vector<double>& values);

// The mean of each number over the lines of a table where it was measured; takes and windows add
// up.
Metrics mean_metrics(const MetricsTable& table);

// The names that any of the tables has: first those of `order`, in its order, then the rest.
std::vector<std::string> names_of(const std::vector<const MetricsTable*>& tables,
                                  const std::vector<std::string>& order);

// How many columns of a terminal `text`, UTF-8, takes.
size_t column_count(std::string_view text);

}  // namespace panache
