// Sections of the page: how it looks.

#include <algorithm>

#include "draw/plot.h"
#include "draw/svg.h"
#include "eval/report_page_html.h"
#include "eval/report_page_sections.h"

namespace panache {
namespace {

// Pixels.
constexpr double kWidth = 860, kMargin = 16, kRight = 24, kTitleHeight = 34, kAxisHeight = 40;
constexpr double kBarHeight = 9, kBarGap = 4, kRowHeight = 36;
constexpr double kLabelSize = 13, kTickSize = 12, kTitleSize = 15;
constexpr const char* kInk = "#222222";
constexpr const char* kSoft = "#666666";
constexpr const char* kGrid = "#e6e6e6";
constexpr const char* kTrack = "#f1f1f1";

double seconds_of(const ContactRow& row) {
  return row.fps > 0 ? static_cast<double>(row.contacts.size()) / row.fps : 0;
}

// The planted spans of one foot, frames [first, end).
std::vector<std::pair<size_t, size_t>> planted_spans(const std::vector<FootContacts>& contacts,
                                                     int foot) {
  std::vector<std::pair<size_t, size_t>> spans;
  for (size_t f = 0; f < contacts.size(); ++f) {
    if (!contacts[f][foot]) continue;
    if (spans.empty() || spans.back().second != f) spans.push_back({f, f});
    spans.back().second = f + 1;
  }
  return spans;
}

struct TimeAxis {
  double left = 0, pixels_per_second = 1;
  double at(double seconds) const { return left + seconds * pixels_per_second; }
};

void draw_row(Svg& svg, const ContactRow& row, double top, const std::string& colour,
              const TimeAxis& axis) {
  svg.text({kMargin, top + kBarHeight + kBarGap / 2 + kLabelSize * 0.35}, row.label,
           {kLabelSize, kInk, TextStyle::Anchor::start, true});
  constexpr const char* kFootNames[kFeet] = {"left", "right"};
  for (int foot = 0; foot < kFeet; ++foot) {
    const double y = top + foot * (kBarHeight + kBarGap);
    svg.text({axis.left - 8, y + kBarHeight - 1}, kFootNames[foot],
             {11, kSoft, TextStyle::Anchor::end});
    svg.rect({axis.left, y}, seconds_of(row) * axis.pixels_per_second, kBarHeight, kTrack, 2);
    for (const auto& [first, end] : planted_spans(row.contacts, foot)) {
      const double from = axis.at(static_cast<double>(first) / row.fps);
      const double to = axis.at(static_cast<double>(end) / row.fps);
      // The left side is the lighter one, as in the strips.
      svg.rect({from, y}, to - from, kBarHeight, tinted(colour, foot == 0 ? 0.52 : 0), 2);
    }
  }
}

std::string contacts_svg(const ContactReport& report) {
  double longest = 0, label_width = 0;
  for (const ContactRow& row : report.rows) {
    longest = std::max(longest, seconds_of(row));
    label_width = std::max(label_width, text_width(row.label, kLabelSize) * 1.1);
  }
  if (longest <= 0) return "";
  TimeAxis axis;
  constexpr double kFootNameWidth = 52;
  axis.left = kMargin + std::min(label_width, kWidth / 3) + kFootNameWidth;
  axis.pixels_per_second = (kWidth - kRight - axis.left) / longest;
  const double bottom = kTitleHeight + kRowHeight * static_cast<double>(report.rows.size());
  Svg svg(kWidth, bottom + kAxisHeight);
  svg.text({kMargin, 22}, report.title, {kTitleSize, kInk, TextStyle::Anchor::start, true});
  for (const double tick : round_ticks(0, longest, 8)) {
    if (tick > longest * (1 + 1e-9)) break;
    svg.line({axis.at(tick), kTitleHeight}, {axis.at(tick), bottom}, {kGrid, 1, 1, ""});
    svg.text({axis.at(tick), bottom + 18}, axis_number(tick) + " s",
             {kTickSize, kSoft, TextStyle::Anchor::middle});
  }
  for (size_t r = 0; r < report.rows.size(); ++r) {
    const double top = kTitleHeight + kRowHeight * static_cast<double>(r) + 7;
    draw_row(svg, report.rows[r], top, palette(r), axis);
  }
  return svg.str();
}

}  // namespace

std::string page_strips(const Report& report) {
  std::string out;
  for (const StripReport& strip : report.strips) {
    if (strip.rows.empty()) continue;
    StripOptions options;
    options.title = strip.title;
    options.seconds_between = strip.seconds_between;
    out += html_drawing(draw_strip(strip.rows, options), "Film strip: " + strip.title, true);
  }
  return out;
}

std::string page_contacts(const Report& report) {
  std::string out;
  for (const ContactReport& contacts : report.contacts) {
    const std::string svg = contacts_svg(contacts);
    if (!svg.empty()) out += html_drawing(svg, "When the feet are planted: " + contacts.title);
  }
  return out;
}

}  // namespace panache
