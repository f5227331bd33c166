#include "learn/style_file.h"

#include <gtest/gtest.h>

#include "learn/make_takes.h"

namespace panache {
namespace {

TEST(Thumbnail, is_small_one_line_and_as_wide_as_its_figures) {
  HumanPositions body{};
  for (size_t j = 0; j < kHumanJoints; ++j) body[j] = {0.01f * static_cast<float>(j), 1, 0.5f};
  const std::vector<HumanPositions> six(6, body);
  const std::string svg = draw_thumbnail(six);
  EXPECT_EQ(svg.find('\n'), std::string::npos);
  EXPECT_NE(svg.find("viewBox=\"0 0 540 190\""), std::string::npos) << svg;
  EXPECT_LT(svg.size(), 6'000u);
}

TEST(Thumbnail, shows_six_instants_of_a_motion_and_one_of_a_pose) {
  const auto figures = [](const Take& take) {
    const std::string svg = thumbnail_of(take);
    size_t count = 0;
    for (size_t at = 0; (at = svg.find("<circle", at)) != svg.npos; ++at) ++count;
    return count;
  };
  EXPECT_EQ(figures(test::walk_take("old", "walk", 90, 0.4f)), 6u);
  EXPECT_EQ(figures(test::walk_take("old", "walk", 20, 0.4f)), 6u);
  EXPECT_EQ(figures(test::walk_take("old", "walk", 1, 0.4f)), 1u);
}

}  // namespace
}  // namespace panache
