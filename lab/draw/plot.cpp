#include "draw/plot.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "draw/svg.h"

namespace panache {
namespace {

// Pixels.
constexpr double kWidth = 760, kHeight = 440, kRight = 26, kBottom = 58;
constexpr double kTitleSize = 17, kLabelSize = 13, kTickSize = 12, kLegendSize = 13;
constexpr const char* kInk = "#222222";
constexpr const char* kSoft = "#666666";
constexpr const char* kGrid = "#e6e6e6";
constexpr const char* kAxis = "#999999";

// Six digits, more than round numbers have, without trailing zeros.
std::string shortest(double value) {
  char text[32];
  const int length = std::snprintf(text, sizeof text, "%.6g", value);
  std::string out(text, length);
  // In locales with a decimal comma.
  std::replace(out.begin(), out.end(), ',', '.');
  return out;
}

struct Range {
  double low = std::numeric_limits<double>::infinity(), high = -low;

  void take(double v) {
    low = std::min(low, v);
    high = std::max(high, v);
  }
  // Makes any range non-empty.
  Range widened() const {
    if (low > high) return {0, 1};
    if (low < high) return *this;
    const double room = low == 0 ? 1 : std::abs(low) * 0.1;
    return {low - room, high + room};
  }
};

// One axis: its scale in pixels, and the ticks to show.
struct Axis {
  Range range;  // Logarithms to base 10 if `log`.
  bool log = false;
  double from = 0, to = 0;  // Pixels.
  std::vector<double> ticks;

  bool holds(double v) const { return std::isfinite(v) && (!log || v > 0); }
  double inner(double v) const { return log ? std::log10(v) : v; }
  double pixel(double v) const {
    const double share = (inner(v) - range.low) / (range.high - range.low);
    // Everything is at the start of a range that is too wide or too narrow for a double.
    return std::isfinite(share) ? from + share * (to - from) : from;
  }
};

// 1, 10, 100, ...; also 2 and 5 if there are few of these.
std::vector<double> log_ticks(const Range& range) {
  std::vector<double> ticks;
  const double decades = range.high - range.low;
  const int step = std::max(1, static_cast<int>(std::ceil(decades / 7)));
  for (int e = static_cast<int>(std::floor(range.low)); e <= range.high + 1e-9; ++e) {
    if (e % step != 0) continue;
    for (const int m : {1, 2, 5}) {
      const double log = e + std::log10(m);
      if (m > 1 && decades > 3) continue;
      const double tick = m * std::pow(10, e);
      const bool inside = log > range.low - 1e-9 && log < range.high + 1e-9;
      if (inside && std::isfinite(tick)) ticks.push_back(tick);
    }
  }
  return ticks;
}

// Extends the range to the nearest 1, 2 or 5 times a power of ten.
Range round_decades(Range range) {
  const auto nearest = [](double log, bool up) {
    const double e = std::floor(log + 1e-9), rest = log - e;
    for (const double m : {10.0, 5.0, 2.0, 1.0}) {
      if (!up && rest > std::log10(m) - 1e-9) return e + std::log10(m);
    }
    for (const double m : {1.0, 2.0, 5.0, 10.0}) {
      if (up && rest < std::log10(m) + 1e-9) return e + std::log10(m);
    }
    return log;
  };
  const Range out = {nearest(range.low, false), nearest(range.high, true)};
  return out.low < out.high ? out : Range{out.low - 1, out.high + 1};
}

void set_up(const std::vector<PlotSeries>& series, bool log_y, Axis& x, Axis& y) {
  y.log = log_y;
  for (const PlotSeries& s : series) {
    for (size_t i = 0; i < std::min(s.x.size(), s.y.size()); ++i) {
      if (!x.holds(s.x[i]) || !y.holds(s.y[i])) continue;
      x.range.take(s.x[i]);
      y.range.take(y.inner(s.y[i]));
    }
  }
  x.range = x.range.widened();
  for (const double tick : round_ticks(x.range.low, x.range.high, 8)) {
    const double slack = 1e-9 * (x.range.high - x.range.low);
    if (tick >= x.range.low - slack && tick <= x.range.high + slack) x.ticks.push_back(tick);
  }
  if (log_y) {
    if (y.range.low > y.range.high) y.range = {-1, 0};
    y.range = round_decades(y.range);
    y.ticks = log_ticks(y.range);
  } else {
    y.range = y.range.widened();
    y.ticks = round_ticks(y.range.low, y.range.high, 6);
    y.range = {y.ticks.front(), y.ticks.back()};
  }
}

// The distinguishable points of a curve: in each pixel column the first, lowest, highest and last.
std::vector<Point> thinned(const std::vector<Point>& points) {
  constexpr size_t kColumn = 4;
  std::vector<Point> out;
  for (size_t i = 0; i < points.size();) {
    size_t end = i + 1, low = i, high = i;
    while (end < points.size() && std::floor(points[end].x) == std::floor(points[i].x)) {
      if (points[end].y < points[low].y) low = end;
      if (points[end].y > points[high].y) high = end;
      ++end;
    }
    if (end - i <= kColumn) {
      out.insert(out.end(), points.begin() + i, points.begin() + end);
    } else {
      for (const size_t k : {i, std::min(low, high), std::max(low, high), end - 1}) {
        out.push_back(points[k]);
      }
    }
    i = end;
  }
  return out;
}

void draw_curve(Svg& svg, const PlotSeries& series, const std::string& colour, const Axis& x,
                const Axis& y) {
  const size_t count = std::min(series.x.size(), series.y.size());
  std::vector<Point> run;
  for (size_t i = 0; i <= count; ++i) {
    if (i < count && x.holds(series.x[i]) && y.holds(series.y[i])) {
      run.push_back({x.pixel(series.x[i]), y.pixel(series.y[i])});
      continue;
    }
    if (run.size() == 1) svg.circle(run[0], 3, colour);
    if (run.size() > 1) svg.polyline(thinned(run), {colour, 2.2, 1, ""});
    run.clear();
  }
  // Markers are shown only if there are few points.
  constexpr size_t kFew = 24;
  for (size_t i = 0; count <= kFew && i < count; ++i) {
    if (x.holds(series.x[i]) && y.holds(series.y[i])) {
      svg.circle({x.pixel(series.x[i]), y.pixel(series.y[i])}, 3, colour);
    }
  }
}

// Draws names and colours in rows from `top` on; returns the end. Without `svg` it only measures.
double draw_legend(Svg* svg, const std::vector<PlotSeries>& series, double left, double top) {
  constexpr double kSwatch = 22, kGap = 20, kRowHeight = 21;
  double x = left, y = top;
  bool any = false;
  for (size_t i = 0; i < series.size(); ++i) {
    if (series[i].name.empty()) continue;
    any = true;
    const double width = kSwatch + 7 + text_width(series[i].name, kLegendSize);
    if (x > left && x + width > kWidth - kRight) {
      x = left;
      y += kRowHeight;
    }
    if (svg) {
      const std::string colour = series[i].colour.empty() ? palette(i) : series[i].colour;
      const double middle = y + kRowHeight / 2;
      svg->line({x + 2, middle}, {x + kSwatch - 2, middle}, {colour, 3.5, 1, ""});
      svg->text({x + kSwatch + 7, middle + kLegendSize * 0.35}, series[i].name,
                {kLegendSize, kInk, TextStyle::Anchor::start});
    }
    x += width + kGap;
  }
  return any ? y + kRowHeight : top;
}

void draw_axes(Svg& svg, const Axis& x, const Axis& y, const std::string& x_label,
               const std::string& y_label) {
  for (const double tick : y.ticks) {
    const double at = y.pixel(tick);
    svg.line({x.from, at}, {x.to, at}, {kGrid, 1, 1, ""});
    svg.text({x.from - 9, at + kTickSize * 0.35}, axis_number(tick),
             {kTickSize, kSoft, TextStyle::Anchor::end});
  }
  svg.line({x.from, y.from}, {x.to, y.from}, {kAxis, 1.2, 1, ""});
  for (const double tick : x.ticks) {
    const double at = x.pixel(tick);
    svg.line({at, y.from}, {at, y.from + 5}, {kAxis, 1.2, 1, ""});
    svg.text({at, y.from + 20}, axis_number(tick), {kTickSize, kSoft, TextStyle::Anchor::middle});
  }
  svg.text({(x.from + x.to) / 2, kHeight - 14}, x_label,
           {kLabelSize, kInk, TextStyle::Anchor::middle});
  svg.text({20, (y.from + y.to) / 2}, y_label,
           {kLabelSize, kInk, TextStyle::Anchor::middle, false, true});
}

}  // namespace

std::string axis_number(double value) {
  const double size = std::abs(value);
  // Smaller doubles have fewer digits than shown, and no powers of ten.
  if (size < 1e-300) return "0";
  const struct {
    double from, unit;
    const char* suffix;
  } kUnits[] = {{1e6, 1e6, "M"}, {1e3, 1e3, "k"}, {1e-3 * (1 - 1e-9), 1, ""}};
  for (const auto& [from, unit, suffix] : kUnits) {
    if (size >= from && size < 1e9) return shortest(value / unit) + suffix;
  }
  const int exponent = static_cast<int>(std::floor(std::log10(size) + 1e-9));
  return shortest(value / std::pow(10, exponent)) + "e" + std::to_string(exponent);
}

std::vector<double> round_ticks(double low, double high, int count) {
  const double raw = (high - low) / std::max(count, 1);
  if (!(raw > 0) || !std::isfinite(raw)) return {low, high};
  const double power = std::pow(10, std::floor(std::log10(raw)));
  const double factor = raw / power;
  const double step = power * (factor < 1.5 ? 1 : factor < 3.5 ? 2 : factor < 7.5 ? 5 : 10);
  const double first = std::floor(low / step + 1e-9), last = std::ceil(high / step - 1e-9);
  std::vector<double> ticks;
  for (int k = 0; k < 100 && first + k <= last; ++k) ticks.push_back((first + k) * step);
  return ticks;
}

std::string line_plot(const std::string& title, const std::string& x_label,
                      const std::string& y_label, const std::vector<PlotSeries>& series,
                      bool log_y) {
  Axis x, y;
  set_up(series, log_y, x, y);
  double tick_width = 0;
  for (const double tick : y.ticks) {
    tick_width = std::max(tick_width, text_width(axis_number(tick), kTickSize));
  }
  constexpr double kTitleLine = 30, kLegendTop = 42, kAir = 14;
  x.from = (y_label.empty() ? 16 : 40) + tick_width;
  x.to = kWidth - kRight;
  y.from = kHeight - kBottom;
  y.to = draw_legend(nullptr, series, x.from, title.empty() ? kAir : kLegendTop) + kAir;

  Svg svg(kWidth, kHeight);
  svg.text({x.from, kTitleLine}, title, {kTitleSize, kInk, TextStyle::Anchor::start, true});
  draw_legend(&svg, series, x.from, title.empty() ? kAir : kLegendTop);
  draw_axes(svg, x, y, x_label, y_label);
  for (size_t i = 0; i < series.size(); ++i) {
    draw_curve(svg, series[i], series[i].colour.empty() ? palette(i) : series[i].colour, x, y);
  }
  return svg.str();
}

}  // namespace panache
