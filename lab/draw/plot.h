#pragma once
// Curves over a common axis, drawn for reports.

#include <string>
#include <vector>

namespace panache {

struct PlotSeries {
  std::string name;
  std::vector<double> x, y;  // Of equal length. Non-finite points leave a gap.
  std::string colour;        // "#rrggbb"; empty for a default.
};

// An SVG file: axes with round numbers, a grid, a legend. With `log_y` the y axis is logarithmic,
// and non-positive points leave a gap.
std::string line_plot(const std::string& title, const std::string& x_label,
                      const std::string& y_label, const std::vector<PlotSeries>& series,
                      bool log_y = false);

// A number as an axis label: "0.25", "1.5k", "20k", "3M", "1e-5".
std::string axis_number(double value);

// Round numbers (1, 2 or 5 times a power of ten apart) that divide [low, high] into about `count`
// parts; the first is at most `low`, the last at least `high`.
std::vector<double> round_ticks(double low, double high, int count);

}  // namespace panache
