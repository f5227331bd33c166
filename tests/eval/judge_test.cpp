#include "eval/judge.h"

#include <cmath>

#include <gtest/gtest.h>

#include "make_styled_takes.h"
#include "one_thread.h"

namespace panache {
namespace {

// The takes themselves, as if a system had put them out from themselves.
std::vector<Output> as_outputs(const std::vector<Take>& takes) {
  std::vector<Output> outputs;
  for (size_t i = 0; i < takes.size(); ++i) {
    Output output{takes[i], static_cast<int>(i), {}};
    for (int f = 0; f < takes[i].frames(); ++f) {
      output.source_frames.push_back(static_cast<float>(f));
    }
    outputs.push_back(std::move(output));
  }
  return outputs;
}

void expect_real_takes_told_apart(const Judge& judge) {
  const Quality real = mean_quality(judge.real());
  EXPECT_EQ(judge.real().size(), 4u);  // Two styles of two contents; neutral is no style.
  EXPECT_EQ(real.takes, 8u);
  EXPECT_EQ(real.windows, 8u * 7);  // A window of 29 frames begins every 10 in 90 frames.
  EXPECT_GT(real["style_accuracy"], 0.99);
  EXPECT_GT(real["content_accuracy"], 0.99);
  EXPECT_GT(real["style_probability"], 0.9);
  EXPECT_DOUBLE_EQ(real["jerk_ratio"], 1);
}

void expect_real_takes_as_good_as_real(const Judge& judge) {
  const std::vector<Take>& styled = judge.test();
  const CellTable cells = judge.judge(as_outputs(styled), styled);
  ASSERT_EQ(cells.size(), judge.real().size());
  for (const auto& [cell, quality] : cells) {
    const Quality& real = judge.real().at(cell);
    EXPECT_DOUBLE_EQ(quality["jerk_ratio"], 1) << cell.first << ", " << cell.second;
    // A square root of a matrix in double precision, whose squares are of the order of 10.
    EXPECT_NEAR(quality["fmd"], 0, 1e-4);
    EXPECT_EQ(quality["style_accuracy"], real["style_accuracy"]);
    EXPECT_EQ(quality["content_accuracy"], real["content_accuracy"]);
    EXPECT_EQ(quality["skating_cm_s"], real["skating_cm_s"]);
    EXPECT_EQ(quality["distance_cm"], 0);
    EXPECT_EQ(std::isnan(quality["cadence_ratio"]), cell.second == "wave");
    if (cell.second == "walk") {
      EXPECT_DOUBLE_EQ(quality["cadence_ratio"], 1);
    }
    EXPECT_TRUE(std::isnan(quality["pose_error_cm"]));
  }
}

void expect_neutral_takes_not_recognised_as_old(const Judge& judge) {
  std::vector<Take> inputs;
  for (const char* content : test::kContents) {
    inputs.push_back(test::styled_take("neutral", content, 4));
  }
  std::vector<Output> outputs = as_outputs(inputs);
  for (Output& output : outputs) output.take.row.style = "old";
  const Quality quality = mean_quality(judge.judge(outputs, inputs));
  EXPECT_EQ(quality.takes, 2u);
  EXPECT_LT(quality["style_accuracy"], 0.01);
  EXPECT_LT(quality["style_probability"], 0.1);
  EXPECT_GT(quality["content_accuracy"], 0.99);
  EXPECT_GT(quality["fmd"], 0.1);
}

void expect_wrong_content_noticed(const Judge& judge) {
  const std::vector<Take> inputs = {test::styled_take("old", "wave", 4)};
  std::vector<Output> outputs = as_outputs(inputs);
  outputs[0].take.row.content = "walk";
  const Quality quality = mean_quality(judge.judge(outputs, inputs));
  EXPECT_LT(quality["content_accuracy"], 0.01);
  EXPECT_GT(quality["style_accuracy"], 0.99);
}

void expect_distance_from_the_source_frame(const Judge& judge) {
  const std::vector<Take> inputs = {test::styled_take("old", "walk", 4)};
  std::vector<Output> outputs = as_outputs(inputs);
  for (HumanPositions& body : outputs[0].take.body) {
    for (Vec3& joint : body) joint.y += 0.03f;
  }
  EXPECT_NEAR(mean_quality(judge.judge(outputs, inputs))["distance_cm"], 3, 1e-3);
  for (float& frame : outputs[0].source_frames) frame = 0;
  EXPECT_GT(mean_quality(judge.judge(outputs, inputs))["distance_cm"], 5);
}

void expect_unknown_cells_left_out(const Judge& judge) {
  const std::vector<Take> inputs = {test::styled_take("old", "walk", 4),
                                    test::styled_take("old", "walk", 5)};
  std::vector<Output> outputs = as_outputs(inputs);
  outputs[0].take.row.style = "sad";
  outputs[1].take.row.content = "jump";
  EXPECT_TRUE(judge.judge(outputs, inputs).empty());
}

// To train a judge takes seconds, so one answers all questions.
TEST(Judge, real_takes_are_recognised_and_what_is_not_like_them_is_not) {
  test::keep_libraries_single_threaded();
  const std::vector<std::string> styles = {"neutral", "old", "proud"};
  const Result<Judge> judge = Judge::create(test::styled_takes(styles, {0, 1, 2}),
                                            test::styled_takes(styles, {4, 5}), {}, 1);
  ASSERT_TRUE(judge.ok()) << judge.error().message;
  expect_real_takes_told_apart(*judge);
  expect_real_takes_as_good_as_real(*judge);
  expect_neutral_takes_not_recognised_as_old(*judge);
  expect_wrong_content_noticed(*judge);
  expect_distance_from_the_source_frame(*judge);
  expect_unknown_cells_left_out(*judge);
}

TEST(Judge, a_judge_that_does_not_know_real_takes_is_refused) {
  test::keep_libraries_single_threaded();
  // What it learns from has the names of two styles exchanged.
  std::vector<Take> training = test::styled_takes({"old", "proud"}, {0, 1});
  for (Take& take : training) take.row.style = take.row.style == "old" ? "proud" : "old";
  const auto judge = Judge::create(training, test::styled_takes({"old", "proud"}, {4}), {}, 1);
  ASSERT_FALSE(judge.ok());
  EXPECT_EQ(judge.error().message,
            "the style classifier recognises 0.000 of the windows of real test takes; expected at "
            "least 0.950, so its word on other motion would mean nothing; give more training takes "
            "of the test takes' styles and contents");
}

// Made-up numbers of two cells of one style and one of another.
CellTable three_cells() {
  CellTable cells;
  cells[{"old", "walk"}]["style_accuracy"] = 1;
  cells[{"old", "wave"}]["style_accuracy"] = 0.5;
  cells[{"proud", "walk"}]["style_accuracy"] = 0;
  cells[{"old", "walk"}]["cadence_ratio"] = 0.8;
  cells[{"old", "walk"}].takes = 90;
  cells[{"old", "wave"}].takes = 1;
  return cells;
}

TEST(CellTables, cells_weigh_the_same_however_many_takes_they_have) {
  const CellTable cells = three_cells();
  EXPECT_DOUBLE_EQ(mean_quality(cells)["style_accuracy"], 0.5);
  EXPECT_EQ(mean_quality(cells).takes, 91u);
  EXPECT_DOUBLE_EQ(by_style(cells).at("old")["style_accuracy"], 0.75);
  EXPECT_DOUBLE_EQ(by_style(cells).at("proud")["style_accuracy"], 0);
  EXPECT_DOUBLE_EQ(by_content(cells).at("walk")["style_accuracy"], 0.5);
}

TEST(CellTables, what_a_cell_did_not_measure_does_not_count_in_the_mean) {
  EXPECT_DOUBLE_EQ(mean_quality(three_cells())["cadence_ratio"], 0.8);
  EXPECT_TRUE(std::isnan(by_content(three_cells()).at("wave")["cadence_ratio"]));
}

TEST(CellTables, some_contents_are_picked_out) {
  const CellTable some = of_contents(three_cells(), {"wave", "jump"});
  ASSERT_EQ(some.size(), 1u);
  EXPECT_EQ(some.begin()->first, (Cell{"old", "wave"}));
}

}  // namespace
}  // namespace panache
