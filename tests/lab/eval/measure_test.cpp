#include "eval/measure.h"

#include <cmath>
#include <set>

#include <gtest/gtest.h>

namespace panache {
namespace {

TEST(Measures, have_keys_and_labels_of_their_own_in_the_order_of_the_report) {
  std::set<std::string> keys, labels;
  for (const Measure& measure : measures()) {
    EXPECT_TRUE(keys.insert(measure.key).second) << measure.key;
    EXPECT_TRUE(labels.insert(measure.label).second) << measure.label;
    EXPECT_EQ(&find_measure(measure.key), &measure);
    EXPECT_NE(measure.of_cell, nullptr) << measure.key;
  }
  // Of report.json; programs that read it count on them.
  std::vector<std::string> order;
  for (const Measure& measure : measures()) order.push_back(measure.key);
  EXPECT_EQ(order, (std::vector<std::string>{"style_accuracy", "content_accuracy",
                                             "style_probability", "jerk_ratio", "skating_ratio",
                                             "skating_cm_s", "pose_error_deg", "pose_error_cm",
                                             "fmd", "cadence_ratio", "distance_cm"}));
}

TEST(Measures, a_cell_is_the_mean_of_its_takes_or_of_its_windows_or_a_ratio_to_real_takes) {
  CellEvidence cell;
  cell.windows = 8;
  cell.values = {1, kNotMeasured, 3};
  cell.real = {4, 6, kNotMeasured};
  EXPECT_EQ(mean_of_takes(cell), 2);
  EXPECT_EQ(mean_against_real(cell), 2.0 / 5);
  cell.values = {1, 2, 3};
  EXPECT_EQ(mean_of_windows(cell), 6.0 / 8);
  cell.values = {kNotMeasured};
  EXPECT_TRUE(std::isnan(mean_of_takes(cell)));
}

TEST(Measures, a_distance_from_an_input_at_unknown_instants_is_not_measured) {
  Take take;
  take.body.resize(2);
  Take input = take;
  for (HumanPositions& body : input.body) body.fill({0, 0.02f, 0});
  const std::vector<float> known = {0, 1}, unknown;
  const auto of_take = find_measure("distance_cm").of_take;
  EXPECT_NEAR(of_take({.take = &take, .input = &input, .source_frames = &known}), 2, 1e-5);
  EXPECT_TRUE(std::isnan(of_take({.take = &take, .input = &input, .source_frames = &unknown})));
  EXPECT_TRUE(std::isnan(of_take({.take = &take})));
}

TEST(Metrics, what_no_measure_said_is_not_measured) {
  Metrics metrics;
  metrics["fmd"] = 2;
  const Metrics& read = metrics;
  EXPECT_EQ(read["fmd"], 2);
  EXPECT_TRUE(std::isnan(read["jerk_ratio"]));
}

}  // namespace
}  // namespace panache
