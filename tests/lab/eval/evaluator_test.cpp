#include <cmath>

#include <gtest/gtest.h>

#include "base/random.h"
#include "eval/evaluator.h"
#include "eval/report_numbers.h"
#include "make_styled_takes.h"
#include "train/matrix_products.h"

namespace panache {
namespace {

// The takes themselves, as if a system had put them out from themselves.
std::vector<StyledTake> as_outputs(const std::vector<Take>& takes) {
  std::vector<StyledTake> outputs;
  for (size_t i = 0; i < takes.size(); ++i) {
    StyledTake output{takes[i], static_cast<int>(i), {}};
    for (int f = 0; f < takes[i].frames(); ++f) {
      output.source_frames.push_back(static_cast<float>(f));
    }
    outputs.push_back(std::move(output));
  }
  return outputs;
}

void expect_real_takes_told_apart(const Evaluator& evaluator) {
  const Metrics real = mean_metrics(evaluator.real());
  EXPECT_EQ(evaluator.real().size(), 4u);  // Two styles of two contents; neutral is no style.
  EXPECT_EQ(real.takes, 8u);
  EXPECT_EQ(real.windows, 8u * 7);  // A window of 29 frames begins every 10 in 90 frames.
  EXPECT_GT(real["style_accuracy"], 0.99);
  EXPECT_GT(real["content_accuracy"], 0.99);
  EXPECT_GT(real["style_probability"], 0.9);
  EXPECT_DOUBLE_EQ(real["jerk_ratio"], 1);
}

void expect_real_takes_as_good_as_real(const Evaluator& evaluator) {
  const std::vector<Take>& styled = evaluator.test();
  const StyleContentTable cells = evaluator.evaluate(as_outputs(styled), styled);
  ASSERT_EQ(cells.size(), evaluator.real().size());
  for (const auto& [cell, metrics] : cells) {
    const Metrics& real = evaluator.real().at(cell);
    EXPECT_DOUBLE_EQ(metrics["jerk_ratio"], 1) << cell.first << ", " << cell.second;
    // A square root of a matrix in double precision, whose squares are of the order of 10.
    EXPECT_NEAR(metrics["fmd"], 0, 1e-4);
    EXPECT_EQ(metrics["style_accuracy"], real["style_accuracy"]);
    EXPECT_EQ(metrics["content_accuracy"], real["content_accuracy"]);
    EXPECT_EQ(metrics["skating_cm_s"], real["skating_cm_s"]);
    EXPECT_EQ(metrics["distance_cm"], 0);
    EXPECT_EQ(std::isnan(metrics["cadence_ratio"]), cell.second == "wave");
    if (cell.second == "walk") {
      EXPECT_DOUBLE_EQ(metrics["cadence_ratio"], 1);
    }
    EXPECT_TRUE(std::isnan(metrics["pose_error_cm"]));
  }
}

void expect_neutral_takes_not_recognised_as_old(const Evaluator& evaluator) {
  std::vector<Take> inputs;
  for (const char* content : test::kContents) {
    inputs.push_back(test::styled_take("neutral", content, 4));
  }
  std::vector<StyledTake> outputs = as_outputs(inputs);
  for (StyledTake& output : outputs) output.take.row.style = "old";
  const Metrics metrics = mean_metrics(evaluator.evaluate(outputs, inputs));
  EXPECT_EQ(metrics.takes, 2u);
  EXPECT_LT(metrics["style_accuracy"], 0.01);
  EXPECT_LT(metrics["style_probability"], 0.1);
  EXPECT_GT(metrics["content_accuracy"], 0.99);
  EXPECT_GT(metrics["fmd"], 0.1);
}

void expect_wrong_content_noticed(const Evaluator& evaluator) {
  const std::vector<Take> inputs = {test::styled_take("old", "wave", 4)};
  std::vector<StyledTake> outputs = as_outputs(inputs);
  outputs[0].take.row.content = "walk";
  const Metrics metrics = mean_metrics(evaluator.evaluate(outputs, inputs));
  EXPECT_LT(metrics["content_accuracy"], 0.01);
  EXPECT_GT(metrics["style_accuracy"], 0.99);
}

void expect_distance_from_the_source_frame(const Evaluator& evaluator) {
  const std::vector<Take> inputs = {test::styled_take("old", "walk", 4)};
  std::vector<StyledTake> outputs = as_outputs(inputs);
  for (HumanPositions& body : outputs[0].take.body) {
    for (Vec3& joint : body) joint.y += 0.03f;
  }
  EXPECT_NEAR(mean_metrics(evaluator.evaluate(outputs, inputs))["distance_cm"], 3, 1e-3);
  for (float& frame : outputs[0].source_frames) frame = 0;
  EXPECT_GT(mean_metrics(evaluator.evaluate(outputs, inputs))["distance_cm"], 5);
}

void expect_unknown_cells_left_out(const Evaluator& evaluator) {
  const std::vector<Take> inputs = {test::styled_take("old", "walk", 4),
                                    test::styled_take("old", "walk", 5)};
  std::vector<StyledTake> outputs = as_outputs(inputs);
  outputs[0].take.row.style = "sad";
  outputs[1].take.row.content = "jump";
  EXPECT_TRUE(evaluator.evaluate(outputs, inputs).empty());
}

// To train a judge takes seconds, so one answers all questions.
TEST(Evaluator, real_takes_are_recognised_and_what_is_not_like_them_is_not) {
  EXPECT_TRUE(prepare_matrix_products().ok());
  const std::vector<std::string> styles = {"neutral", "old", "proud"};
  const Evaluator evaluator = Evaluator::create(test::styled_takes(styles, {0, 1, 2}),
                                                test::styled_takes(styles, {4, 5}), 1);
  expect_real_takes_told_apart(evaluator);
  expect_real_takes_as_good_as_real(evaluator);
  expect_neutral_takes_not_recognised_as_old(evaluator);
  expect_wrong_content_noticed(evaluator);
  expect_distance_from_the_source_frame(evaluator);
  expect_unknown_cells_left_out(evaluator);
}

TEST(Evaluator, one_that_does_not_know_real_takes_still_measures_them) {
  EXPECT_TRUE(prepare_matrix_products().ok());
  // What it learns from has the names of two styles exchanged.
  std::vector<Take> training = test::styled_takes({"old", "proud"}, {0, 1});
  for (Take& take : training) take.row.style = take.row.style == "old" ? "proud" : "old";
  const Evaluator evaluator =
      Evaluator::create(training, test::styled_takes({"old", "proud"}, {4}), 1);
  const Metrics real = mean_metrics(evaluator.real());
  EXPECT_LT(real["style_accuracy"], 0.1);
  EXPECT_EQ(real["jerk_ratio"], 1);
  EXPECT_GE(real["skating_cm_s"], 0);
}

// Made-up numbers of two cells of one style and one of another.
StyleContentTable three_cells() {
  StyleContentTable cells;
  cells[{"old", "walk"}]["style_accuracy"] = 1;
  cells[{"old", "wave"}]["style_accuracy"] = 0.5;
  cells[{"proud", "walk"}]["style_accuracy"] = 0;
  cells[{"old", "walk"}]["cadence_ratio"] = 0.8;
  cells[{"old", "walk"}].takes = 90;
  cells[{"old", "wave"}].takes = 1;
  return cells;
}

TEST(StyleContentTables, cells_weigh_the_same_however_many_takes_they_have) {
  const StyleContentTable cells = three_cells();
  EXPECT_DOUBLE_EQ(mean_metrics(cells)["style_accuracy"], 0.5);
  EXPECT_EQ(mean_metrics(cells).takes, 91u);
  EXPECT_DOUBLE_EQ(by_style(cells).at("old")["style_accuracy"], 0.75);
  EXPECT_DOUBLE_EQ(by_style(cells).at("proud")["style_accuracy"], 0);
  EXPECT_DOUBLE_EQ(by_content(cells).at("walk")["style_accuracy"], 0.5);
}

TEST(StyleContentTables, what_a_cell_did_not_measure_does_not_count_in_the_mean) {
  EXPECT_DOUBLE_EQ(mean_metrics(three_cells())["cadence_ratio"], 0.8);
  EXPECT_TRUE(std::isnan(by_content(three_cells()).at("wave")["cadence_ratio"]));
}

torch::Tensor cloud(int64_t rows, int64_t columns, uint64_t seed) {
  torch::Tensor tensor = torch::empty({rows, columns});
  Random random(seed);
  for (int64_t i = 0; i < tensor.numel(); ++i) tensor.data_ptr<float>()[i] = random.normal();
  return tensor;
}

// Four points on two axes of the plane turned by `angle`, whose covariance has the variances 4 and
// 1 along them.
torch::Tensor cross(double angle) {
  const double a = std::sqrt(6), b = std::sqrt(1.5), c = std::cos(angle), s = std::sin(angle);
  return torch::tensor({a * c, a * s, -a * c, -a * s, -b * s, b * c, b * s, -b * c},
                       torch::kFloat64)
      .view({4, 2});
}

TEST(Frechet, a_cloud_has_no_distance_from_itself) {
  const torch::Tensor x = cloud(50, 8, 1);
  // Roots of eigenvalues that differ in the last digits of double precision.
  EXPECT_NEAR(frechet_distance(x, x), 0, 1e-6);
}

TEST(Frechet, a_shifted_cloud_is_as_far_as_the_square_of_the_shift) {
  const torch::Tensor x = cloud(50, 8, 1);
  torch::Tensor shift = torch::zeros({8});
  shift[2] = 3;
  shift[5] = -4;
  // The sums are rounded to single precision: 1e-7 of numbers below 10, squared.
  EXPECT_NEAR(frechet_distance(x, x + shift), 25, 1e-4);
}

TEST(Frechet, in_one_dimension_deviations_differ_as_the_square_of_their_difference) {
  // Means 0 and 5, deviations 1 and 3: three points (-s, 0, s) have the deviation s.
  const torch::Tensor a = torch::tensor({-1.0, 0.0, 1.0}).view({3, 1});
  const torch::Tensor b = torch::tensor({2.0, 5.0, 8.0}).view({3, 1});
  EXPECT_NEAR(frechet_distance(a, b), 25 + 4, 1e-9);
  EXPECT_NEAR(frechet_distance(b, a), 25 + 4, 1e-9);
}

TEST(Frechet, covariances_that_do_not_commute_are_compared_right) {
  // S_a = diag(4, 1), S_b the same turned by 45 degrees: S_a S_b has the trace 12.5 and the
  // determinant 16, so its root has the trace sqrt(12.5 + 2 * sqrt(16)).
  const double expected = 10 - 2 * std::sqrt(12.5 + 2 * std::sqrt(16.0));
  EXPECT_NEAR(frechet_distance(cross(0), cross(M_PI / 4)), expected, 1e-9);
}

TEST(Frechet, fewer_rows_than_columns_give_a_finite_distance) {
  const torch::Tensor x = cloud(5, 40, 2).to(torch::kFloat64);
  EXPECT_NEAR(frechet_distance(x, x), 0, 1e-5);
  // Twice as far from the mean: S becomes 4 S, and S + 4 S - 2 * 2 S = S.
  const torch::Tensor mean = x.mean(0), centred = x - mean;
  const double trace = centred.square().sum().item<double>() / 4;
  EXPECT_NEAR(frechet_distance(x, mean + 2 * centred), trace, 1e-4 * trace);
}

TEST(Frechet, a_single_row_is_a_point) {
  const torch::Tensor x = torch::tensor({1.0, 2.0}).view({1, 2});
  const torch::Tensor y = torch::tensor({1.0, 5.0}).view({1, 2});
  EXPECT_NEAR(frechet_distance(x, y), 9, 1e-12);
}

}  // namespace
}  // namespace panache
