#include "draw/plot.h"

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>

#include <gtest/gtest.h>

#include "draw/svg.h"
#include "base/xml_check.h"

namespace panache {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

// Where PANACHE_DRAWINGS names a folder, the drawings are left there to be looked at.
void keep(const std::string& svg, const std::string& name) {
  const char* folder = std::getenv("PANACHE_DRAWINGS");
  if (folder) std::ofstream(std::string(folder) + "/" + name) << svg;
}

PlotSeries made_up_loss(const std::string& name, double end, int steps) {
  PlotSeries series{name, {}, {}, ""};
  for (int i = 0; i < steps; ++i) {
    series.x.push_back(20000.0 * i / (steps - 1));
    series.y.push_back(end + std::exp(-i / (0.12 * steps)) * (1 + 0.1 * std::sin(i * 12.9898)) +
                       0.05 * end * std::sin(i * 78.233));
  }
  return series;
}

// The elements that begin with `start` and have `part` in them.
std::vector<std::string> elements(const std::string& svg, const std::string& start,
                                  const std::string& part) {
  std::vector<std::string> out;
  for (size_t at = svg.find(start); at != svg.npos; at = svg.find(start, at + 1)) {
    const std::string element = svg.substr(at, svg.find('>', at) - at);
    if (element.find(part) != element.npos) out.push_back(element);
  }
  return out;
}

std::string attribute(const std::string& element, const std::string& name) {
  const size_t start = element.find(" " + name + "=\"") + name.size() + 3;
  return element.substr(start, element.find('"', start) - start);
}

TEST(LinePlot, a_loss_on_a_logarithmic_axis) {
  const std::string svg = line_plot(
      "Training loss <panache> & smith2019", "step", "mean squared error",
      {made_up_loss("pose, training", 0.02, 20000), made_up_loss("pose, held out", 0.035, 40),
       made_up_loss("timing, training", 0.004, 300), made_up_loss("contact", 0.1, 300)},
      true);
  keep(svg, "loss.svg");
  EXPECT_EQ(xml_problem(svg), "");
  EXPECT_EQ(occurrences(svg, ">pose, held out</text>"), 1u);
  EXPECT_EQ(occurrences(svg, "<polyline"), 4u);
  EXPECT_EQ(occurrences(svg, ">0.01</text>"), 1u);
  EXPECT_EQ(occurrences(svg, ">20k</text>"), 1u);
  // 20,000 points are thinned to what 700 pixels can show.
  EXPECT_LT(svg.size(), 60000u);
}

TEST(LinePlot, few_points_are_marked) {
  const std::string svg = line_plot(
      "Style recognised by strength", "strength", "share of windows",
      {{"panache", {0, 0.25, 0.5, 0.75, 1, 1.25, 1.5, 2}, {0, .05, .62, .97, .997, .999, 1, 1}, ""},
       {"smith2019",
        {0, .25, .5, .75, 1, 1.25, 1.5, 2},
        {0, .05, .55, .95, .998, .999, .996, .9},
        ""}});
  keep(svg, "strength.svg");
  EXPECT_EQ(xml_problem(svg), "");
  EXPECT_EQ(occurrences(svg, "<circle"), 16u);
  EXPECT_EQ(occurrences(svg, "<polyline"), 2u);
}

TEST(LinePlot, ticks_have_lines_and_curves_go_by_them) {
  const std::string svg =
      line_plot("", "x", "y", {{"up", {0, 10}, {0, 10}, "#123456"}, {"", {0, 10}, {10, 0}, ""}});
  // A line across for each of 0, 2, ..., 10; the axis below with a mark for each of 0, 1, ..., 10.
  EXPECT_EQ(occurrences(svg, "stroke=\"#e6e6e6\""), 6u);
  EXPECT_EQ(occurrences(svg, "stroke=\"#999999\""), 1u + 11u);
  for (const std::string& line : elements(svg, "<line", "#999999")) {  // Marks are below it.
    EXPECT_GE(std::stod(attribute(line, "y2")), std::stod(attribute(line, "y1")));
  }
  // The curve and its sample beside its name; one without a name has none.
  EXPECT_EQ(occurrences(svg, "stroke=\"#123456\""), 2u);
  EXPECT_EQ(occurrences(svg, "stroke=\"" + palette(1) + "\""), 1u);
  // From the corner of the axes up to where the highest line ends.
  const std::vector<std::string> grid = elements(svg, "<line", "#e6e6e6");
  const std::vector<std::string> curves = elements(svg, "<polyline", "#123456");
  ASSERT_EQ(grid.size(), 6u);
  ASSERT_EQ(curves.size(), 1u);
  EXPECT_EQ(attribute(curves[0], "points"),
            attribute(grid.front(), "x1") + "," + attribute(grid.front(), "y1") + " " +
                attribute(grid.back(), "x2") + "," + attribute(grid.back(), "y2"));
}

TEST(LinePlot, points_that_cannot_be_shown_leave_a_gap) {
  const PlotSeries broken{"", {0, 1, 2, 3, 4, 5}, {1, 2, kNaN, 3, 4, 5}, "#123456"};
  EXPECT_EQ(occurrences(line_plot("", "", "", {broken}), "<polyline"), 2u);
  const PlotSeries negative{"", {0, 1, 2, 3, 4, 5}, {1, 2, 0, -3, 4, 5}, "#123456"};
  EXPECT_EQ(occurrences(line_plot("", "", "", {negative}), "<polyline"), 1u);
  EXPECT_EQ(occurrences(line_plot("", "", "", {negative}, true), "<polyline"), 2u);
}

TEST(LinePlot, a_logarithmic_axis_of_two_decades_has_ticks_at_1_2_and_5) {
  const std::string svg = line_plot("", "", "", {{"", {1000, 8000}, {3, 300}, "#123456"}}, true);
  for (const char* tick : {">5<", ">10<", ">20<", ">50<", ">100<", ">200<"}) {
    EXPECT_EQ(occurrences(svg, tick), 1u) << tick;
  }
  for (const char* tick : {">6<", ">30<", ">60<"}) EXPECT_EQ(occurrences(svg, tick), 0u) << tick;
}

TEST(LinePlot, whatever_it_is_given_is_a_drawing_still) {
  constexpr double kInf = std::numeric_limits<double>::infinity();
  for (const bool log_y : {false, true}) {
    for (const std::vector<PlotSeries>& series :
         std::vector<std::vector<PlotSeries>>{{},
                                              {{"empty", {}, {}, ""}},
                                              {{"one point", {3}, {7}, ""}},
                                              {{"constant", {0, 1, 2}, {5, 5, 5}, ""}},
                                              {{"zero", {0, 0}, {0, 0}, ""}},
                                              {{"vast", {-1e308, 1e308}, {-1e308, 1e308}, ""}},
                                              {{"tiny", {0, 5e-324}, {1e-310, 5e-324}, ""}},
                                              {{"close", {1e17, 1e17 + 16}, {1e17, 1e17 + 16}, ""}},
                                              {{"not finite", {kNaN, kInf}, {-kInf, kNaN}, ""}},
                                              {{"uneven", {1, 2, 3}, {1}, ""}},
                                              {{std::string(500, 'n'), {0, 1}, {1, 2}, ""}}}) {
      const std::string svg = line_plot("t", "x", "y", series, log_y);
      EXPECT_EQ(xml_problem(svg), "");
      EXPECT_EQ(svg.find("nan"), svg.npos) << svg;
      EXPECT_EQ(svg.find("inf"), svg.npos) << svg;
    }
  }
}

TEST(RoundTicks, are_round_and_cover_the_range) {
  EXPECT_EQ(round_ticks(0, 10, 5), (std::vector<double>{0, 2, 4, 6, 8, 10}));
  EXPECT_EQ(round_ticks(-3, 11, 3), (std::vector<double>{-5, 0, 5, 10, 15}));
  EXPECT_EQ(round_ticks(0, 20000, 8), (std::vector<double>{0, 2000, 4000, 6000, 8000, 10000, 12000,
                                                           14000, 16000, 18000, 20000}));
  EXPECT_EQ(round_ticks(0, 10, 1), (std::vector<double>{0, 10}));
  EXPECT_EQ(round_ticks(0, 10, 0), (std::vector<double>{0, 10}));
  EXPECT_EQ(round_ticks(3, 3, 5), (std::vector<double>{3, 3}));
}

TEST(AxisNumber, is_short) {
  EXPECT_EQ(axis_number(0), "0");
  EXPECT_EQ(axis_number(0.1 + 0.2), "0.3");
  EXPECT_EQ(axis_number(-0.25), "-0.25");
  EXPECT_EQ(axis_number(1500), "1.5k");
  EXPECT_EQ(axis_number(20000), "20k");
  EXPECT_EQ(axis_number(2.5e6), "2.5M");
  EXPECT_EQ(axis_number(0.001), "0.001");
  EXPECT_EQ(axis_number(2e-5), "2e-5");
  EXPECT_EQ(axis_number(3e12), "3e12");
}

}  // namespace
}  // namespace panache
