#include "draw/strip.h"

#include <cmath>
#include <fstream>
#include <limits>
#include <numbers>
#include <sstream>

#include <gtest/gtest.h>

#include "draw/svg.h"
#include "base/xml_check.h"

namespace panache {
namespace {

// A body of round numbers that walks ahead, its legs and arms swinging; swing 0 stands in a T-pose.
HumanPositions made_up_body(double seconds, float swing, float stoop, float heading) {
  HumanPositions body;
  const float phase = static_cast<float>(seconds * 2 * std::numbers::pi / 1.1);
  const auto set = [&](HumanJoint joint, Vec3 p) { body[index(joint)] = p; };
  const float hips_up = 0.88f + 0.02f * swing * std::cos(2 * phase) - 0.06f * stoop;
  set(HumanJoint::hips, {0, hips_up, 0});
  set(HumanJoint::spine, {0, hips_up + 0.12f, 0.03f * stoop});
  set(HumanJoint::chest, {0, hips_up + 0.28f, 0.1f * stoop});
  set(HumanJoint::neck, {0, hips_up + 0.47f - 0.02f * stoop, 0.22f * stoop});
  set(HumanJoint::head, {0, hips_up + 0.55f - 0.05f * stoop, 0.32f * stoop});
  for (const float side : {1.0f, -1.0f}) {
    const int arm = index(side > 0 ? HumanJoint::left_shoulder : HumanJoint::right_shoulder);
    const int leg = index(side > 0 ? HumanJoint::left_upper_leg : HumanJoint::right_upper_leg);
    const Vec3 chest = body[index(HumanJoint::chest)];
    const float a = -side * std::sin(phase) * 0.55f * swing;
    body[arm] = chest + Vec3{0.05f * side, 0.13f, 0};
    body[arm + 1] = chest + Vec3{0.18f * side, 0.13f, 0.05f * stoop};
    if (swing > 0) {
      body[arm + 2] = body[arm + 1] + Vec3{0.05f * side, -0.25f * std::cos(a), 0.25f * std::sin(a)};
      const float bend = a + 0.4f;
      body[arm + 3] = body[arm + 2] + Vec3{0, -0.23f * std::cos(bend), 0.23f * std::sin(bend)};
    } else {
      body[arm + 2] = body[arm + 1] + Vec3{0.25f * side, 0, 0};
      body[arm + 3] = body[arm + 2] + Vec3{0.23f * side, 0, 0};
    }
    const float t = side * std::sin(phase) * 0.48f * swing;
    const float knee = std::max(0.0f, side * std::cos(phase)) * 0.9f * swing + 0.08f * swing;
    body[leg] = Vec3{0.09f * side, hips_up - 0.04f, 0};
    body[leg + 1] = body[leg] + Vec3{0, -0.41f * std::cos(t), 0.41f * std::sin(t)};
    const float shin = t - knee;
    body[leg + 2] = body[leg + 1] + Vec3{0, -0.38f * std::cos(shin), 0.38f * std::sin(shin)};
    body[leg + 3] =
        body[leg + 2] + Vec3{0, -0.05f * std::cos(shin) + 0.13f * std::sin(shin), 0.13f};
  }
  const Vec3 travel = {0, 0, swing * 1.3f * static_cast<float>(seconds)};
  for (Vec3& p : body) {
    p += travel;
    p = {p.x * std::cos(heading) + p.z * std::sin(heading), p.y,
         p.z * std::cos(heading) - p.x * std::sin(heading)};
  }
  return body;
}

StripRow made_up_row(const std::string& label, float swing, float stoop, float heading = 0.7f) {
  StripRow row{label, {}, ""};
  for (int f = 0; f < 9; ++f) {
    row.frames.push_back(made_up_body(0.25 * f, swing, stoop, heading));
  }
  return row;
}

// Where PANACHE_DRAWINGS names a folder, the drawings are left there to be looked at.
void keep_strip(const std::string& svg, const std::string& name) {
  const char* folder = std::getenv("PANACHE_DRAWINGS");
  if (folder) std::ofstream(std::string(folder) + "/" + name) << svg;
}

TEST(Strip, has_a_head_for_every_frame_and_is_well_formed) {
  StripOptions options;
  options.title = "Made-up <walk> & stand";
  const std::string svg = draw_strip(
      {made_up_row("neutral", 1, 0), made_up_row("old", 0.6f, 1), made_up_row("T-pose", 0, 0)},
      options);
  keep_strip(svg, "strip.svg");
  EXPECT_EQ(xml_problem(svg), "");
  // A head and its rim.
  EXPECT_EQ(occurrences(svg, "<circle"), 2u * 3 * 9);
  EXPECT_EQ(occurrences(svg, ">old</text>"), 1u);
  EXPECT_EQ(occurrences(svg, ">0.25 s</text>"), 1u);
  EXPECT_EQ(occurrences(svg, ">2.0 s</text>"), 1u);
}

// The numbers behind `attribute`="..." in all circles that are heads.
std::vector<double> head_numbers(const std::string& svg, const std::string& attribute) {
  std::vector<double> numbers;
  for (size_t at = svg.find("<circle"); at != svg.npos; at = svg.find("<circle", at + 1)) {
    const size_t value = svg.find(" " + attribute + "=\"", at) + attribute.size() + 3;
    if (svg.compare(svg.find("fill=\"", at) + 6, 7, "#ffffff") == 0) continue;
    numbers.push_back(std::stod(svg.substr(value)));
  }
  return numbers;
}

TEST(Strip, figures_stand_at_equal_distances) {
  const std::vector<double> x =
      head_numbers(draw_strip({made_up_row("stand", 0, 0)}, StripOptions()), "cx");
  ASSERT_EQ(x.size(), 9u);
  for (size_t i = 2; i < x.size(); ++i) EXPECT_NEAR(x[i] - x[i - 1], x[1] - x[0], 0.011);
  EXPECT_GT(x[1] - x[0], 30);
}

TEST(Strip, figures_stand_beside_their_labels_and_inside_of_the_drawing) {
  for (const bool travel : {false, true}) {
    StripOptions options;
    options.travel = travel;
    const std::string svg = draw_strip({made_up_row("a T-pose", 0, 0)}, options);
    const double width = std::stod(svg.substr(svg.find("width=\"") + 7));
    double left = width, right = 0;
    for (size_t at = svg.find("points=\""); at != svg.npos; at = svg.find("points=\"", at + 1)) {
      std::istringstream points(svg.substr(at + 8, svg.find('"', at + 8) - at - 8));
      std::string point;
      while (points >> point) {
        left = std::min(left, std::stod(point));
        right = std::max(right, std::stod(point));
      }
    }
    EXPECT_GT(left, 20 + text_width("a T-pose", 15)) << travel;
    EXPECT_LT(right, width - 20) << travel;
    // Metres are marked where figures travel.
    EXPECT_EQ(svg.find(" m</text>") != svg.npos, travel);
  }
}

TEST(Strip, limbs_are_thinner_than_heads) {
  const std::string svg = draw_strip({made_up_row("walk", 1, 0)}, {});
  const double head = head_numbers(svg, "r").at(0);
  size_t lines = 0;
  for (size_t at = svg.find("<polyline"); at != svg.npos; at = svg.find("<polyline", at + 1)) {
    EXPECT_LT(std::stod(svg.substr(svg.find("stroke-width=\"", at) + 14)), 2 * head);
    ++lines;
  }
  EXPECT_GT(lines, 9u);
  EXPECT_LT(head, 0.2 * StripOptions().pixels_per_metre);
}

TEST(Strip, travelling_figures_stand_where_they_are) {
  StripOptions options;
  options.travel = true;
  options.yaw_deg = 60;
  options.pixels_per_metre = 100;
  const std::string svg =
      draw_strip({made_up_row("walk", 1, 0), made_up_row("slow walk", 0.5f, 0)}, options);
  keep_strip(svg, "travel.svg");
  EXPECT_EQ(xml_problem(svg), "");
  const std::vector<double> x = head_numbers(svg, "cx");
  ASSERT_EQ(x.size(), 18u);
  // 1.3 m/s for 2 s, seen 60 degrees from the side: half as long.
  EXPECT_NEAR(x[8] - x[0], 130, 0.02);
  EXPECT_NEAR(x[17] - x[9], 65, 0.02);
  EXPECT_EQ(x[0], x[9]);
}

TEST(Strip, travelling_rows_begin_below_each_other_wherever_they_were) {
  StripOptions options;
  options.travel = true;
  const StripRow here = made_up_row("here", 1, 0, 0);
  StripRow there = here;
  for (HumanPositions& body : there.frames) {
    for (Vec3& p : body) p.z += 5;
  }
  const std::vector<double> x = head_numbers(draw_strip({here, there}, options), "cx");
  ASSERT_EQ(x.size(), 18u);
  for (size_t i = 0; i < 9; ++i) EXPECT_NEAR(x[i], x[i + 9], 0.02);
}

// Arms have three points, legs four.
TEST(Strip, what_is_nearer_to_the_viewer_is_in_front) {
  const auto front = [](double pitch_deg) {
    StripRow row = made_up_row("", 0, 0);
    row.frames.resize(1);
    StripOptions options;
    options.pitch_deg = pitch_deg;
    const std::string svg = draw_strip({row}, options);
    const size_t points = svg.find("points=\"", svg.rfind("<polyline")) + 8;
    return occurrences(svg.substr(points, svg.find('"', points) - points), ",");
  };
  EXPECT_EQ(front(80), 3u) << "from above";
  EXPECT_EQ(front(-80), 4u) << "from below";
}

TEST(Strip, times_are_left_out_where_they_would_touch) {
  StripOptions options;
  options.pixels_per_metre = 30;
  const std::string svg = draw_strip({made_up_row("", 0, 0)}, options);
  double last = -1e9;
  for (size_t end = svg.find(" s</text>"); end != svg.npos; end = svg.find(" s</text>", end + 1)) {
    const size_t text = svg.rfind("<text", end), label = svg.rfind('>', end) + 1;
    const double x = std::stod(svg.substr(svg.find(" x=\"", text) + 4));
    const double half = text_width(svg.substr(label, end + 2 - label), 11) / 2;
    EXPECT_GT(x - half, last);
    last = x + half;
  }
  EXPECT_LT(occurrences(svg, " s</text>"), 9u);
  EXPECT_GT(occurrences(svg, " s</text>"), 1u);
}

TEST(Strip, looks_the_same_whichever_way_the_motion_of_a_row_heads) {
  const StripRow a = made_up_row("walk", 1, 0.4f, 0), b = made_up_row("walk", 1, 0.4f, 2.5f);
  const std::vector<double> alone = head_numbers(draw_strip({a}, {}), "cx");
  const std::vector<double> both = head_numbers(draw_strip({a, b}, {}), "cx");
  ASSERT_EQ(alone.size(), 9u);
  ASSERT_EQ(both.size(), 18u);
  for (size_t i = 0; i < 18; ++i) EXPECT_NEAR(both[i], alone[i % 9], 0.02) << i;
}

TEST(Strip, whoever_stands_looks_the_same_whichever_way_she_faces) {
  const std::string ahead = draw_strip({made_up_row("stands", 0, 0.4f, 0)}, {});
  for (const float heading : {0.8f, 2.5f, -1.6f}) {
    const std::string turned = draw_strip({made_up_row("stands", 0, 0.4f, heading)}, {});
    for (const char* axis : {"cx", "cy"}) {
      const std::vector<double> a = head_numbers(ahead, axis), b = head_numbers(turned, axis);
      ASSERT_EQ(a.size(), b.size());
      for (size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], 0.02) << heading;
    }
  }
}

TEST(Strip, a_long_name_takes_lines_and_no_width) {
  const std::string name = "dataset-1_walk_normal_001 on a character with a very long name";
  const std::string svg = draw_strip({made_up_row(name, 1, 0)}, {});
  keep_strip(svg, "long.svg");
  EXPECT_EQ(xml_problem(svg), "");
  const auto width = [](const std::string& drawing) {
    return std::stod(drawing.substr(drawing.find("width=\"") + 7));
  };
  EXPECT_LT(width(svg) - width(draw_strip({made_up_row("walk", 1, 0)}, {})), 190);
  EXPECT_EQ(svg.find(name), svg.npos);
  EXPECT_NE(svg.find(">dataset-1_walk_"), svg.npos);
}

TEST(Strip, a_jump_is_seen_as_height) {
  StripRow row = made_up_row("jump", 0, 0);
  for (Vec3& p : row.frames[4]) p.y += 0.5f;
  StripOptions options;
  options.pitch_deg = 0;
  options.pixels_per_metre = 100;
  const std::vector<double> y = head_numbers(draw_strip({row}, options), "cy");
  ASSERT_EQ(y.size(), 9u);
  EXPECT_NEAR(y[3] - y[4], 50, 0.02);
}

TEST(Strip, figures_that_are_not_finite_are_left_out) {
  StripRow row = made_up_row("broken", 1, 0);
  row.frames[0][3].x = std::numeric_limits<float>::quiet_NaN();
  row.frames[5][20].y = std::numeric_limits<float>::infinity();
  const std::string svg = draw_strip({row}, {});
  EXPECT_EQ(xml_problem(svg), "");
  EXPECT_EQ(occurrences(svg, "<circle"), 2u * 7);
  EXPECT_EQ(svg.find("nan"), svg.npos);
}

TEST(Strip, nothing_to_draw_is_a_drawing_still) {
  EXPECT_EQ(xml_problem(draw_strip({}, {})), "");
  EXPECT_EQ(xml_problem(draw_strip({{"empty", {}, ""}}, {})), "");
}

}  // namespace
}  // namespace panache
