#include "eval/report_numbers.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace panache {
std::string number_text(double value, int digits) {
  // A double has up to 309 digits before the decimal point.
  char text[400];
  if (!std::isfinite(value)) return kDash;
  const auto [end, error] =
      std::to_chars(text, text + sizeof text, value, std::chars_format::fixed, digits);
  if (error != std::errc()) return kDash;
  const std::string_view written(text, end);
  // Avoids "-0".
  const bool zero = written.find_first_not_of("-0.") == written.npos;
  return std::string(zero && written.starts_with('-') ? written.substr(1) : written);
}

std::string count_text(size_t count) {
  if (count == 0) return kDash;
  std::string text = std::to_string(count);
  for (size_t at = text.size(); at > 3; at -= 3) text.insert(at - 3, ",");
  return text;
}

double quantile(std::vector<double> values, double at) {
  std::erase_if(values, [](double v) { return !std::isfinite(v); });
  if (values.empty()) return kNotMeasured;
  std::sort(values.begin(), values.end());
  const double position = std::clamp(at, 0.0, 1.0) * static_cast<double>(values.size() - 1);
  const size_t below = static_cast<size_t>(position);
  const size_t above = std::min(below + 1, values.size() - 1);
  return values[below] + (position - static_cast<double>(below)) * (values[above] - values[below]);
}

double finite_mean(const std::vector<double>& values) {
  double sum = 0;
  size_t count = 0;
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    sum += value;
    ++count;
  }
  return count > 0 ? sum / static_cast<double>(count) : kNotMeasured;
}

Metrics mean_metrics(const std::vector<const Metrics*>& lines) {
  Metrics mean;
  for (const Metrics* line : lines) {
    mean.takes += line->takes;
    mean.windows += line->windows;
  }
  for (const Measure& measure : measures()) {
    std::vector<double> values;
    for (const Metrics* line : lines) values.push_back((*line)[measure.key]);
    mean[measure.key] = finite_mean(values);
  }
  return mean;
}

}  // namespace panache
