#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "eval/evaluate.h"
#include "eval/toy_system/toy_system.h"
#include "make_model.h"
#include "make_styles.h"
#include "takes/manifest.h"
#include "temporary_folder.h"
#include "train/matrix_products.h"

namespace panache {
namespace {

// What an evaluation rejects before any classifier is trained; what it reports is tested through
// the program, which evaluates as a user would.
class EvaluateTest : public testing::Test {
 protected:
  EvaluateTest() {
    test::write_styles(temporary_.path(), {"neutral", "old"}, 1);
    const std::vector<ManifestRow> rows = *read_manifest(temporary_.path() + "takes.csv", 0);
    options_.training = rows;
    options_.styles = {{"old", {"old"}, ""}};
    for (const ManifestRow& row : rows) {
      if (row.test) options_.test.push_back(row);
    }
  }
  // Changes the test takes, in the manifest of the training takes as well.
  template <typename Change>
  void change_tests(const Change& change) {
    for (ManifestRow& row : options_.test) change(row);
    for (ManifestRow& row : options_.training) {
      if (row.test) change(row);
    }
  }
  std::string rejection() const {
    const Result<Report> report = evaluate(options_);
    return report.ok() ? "accepted" : report.error().message;
  }

  const test::TemporaryFolder temporary_;
  EvaluateOptions options_;
};

TEST_F(EvaluateTest, test_takes_of_contents_that_nothing_was_trained_on_do_not_judge) {
  change_tests([](ManifestRow& row) {
    if (row.neutral) row.content = "jump";
  });
  EXPECT_EQ(rejection(),
            "no neutral test take of a content that is trained on; expected rows with neutral 1");
}

TEST_F(EvaluateTest, test_takes_of_styles_that_nothing_was_trained_on_do_not_judge) {
  change_tests([](ManifestRow& row) {
    if (!row.neutral) row.style = "sad";
  });
  EXPECT_EQ(rejection(),
            "no styled test take of a style and content that are trained on; expected rows with "
            "neutral 0");
}

TEST_F(EvaluateTest, a_test_take_that_cannot_be_read_is_named) {
  options_.test.back().path = temporary_.path() + "none.bvh";
  EXPECT_EQ(rejection(), temporary_.path() + "none.bvh: cannot be read: No such file or directory");
}

// Known before a classifier is trained.
TEST_F(EvaluateTest, an_unseen_content_without_a_styled_test_take_is_named) {
  options_.unseen = {*read_split("wave,kick")};
  EXPECT_EQ(rejection(),
            "unseen content 'kick' has no styled test take; expected contents of the styled test "
            "takes: walk, wave");
}

TEST(ReadSplit, three_have_names) {
  EXPECT_EQ(read_split("A")->contents.size(), 3u);
  EXPECT_EQ(read_split("B")->contents.size(), 5u);
  EXPECT_EQ(read_split("C")->contents.size(), 4u);
  EXPECT_EQ(read_split("C")->name, "C");
}

TEST(ReadSplit, others_are_lists_of_contents) {
  EXPECT_EQ(read_split("wait")->contents, (std::vector<std::string>{"wait"}));
  EXPECT_EQ(read_split("pick-up,wait")->contents, (std::vector<std::string>{"pick-up", "wait"}));
  EXPECT_EQ(read_split("pick-up,wait")->name, "pick-up+wait");
  for (const char* wrong : {"", ",", "wait,", ",wait", "walk,,wait", "wait,wait"}) {
    EXPECT_FALSE(read_split(wrong).ok()) << wrong;
  }
}

// A system is added by a folder (eval/toy_system) and a line (in the constructor below).

using Json = nlohmann::json;

class ToySystemTest : public testing::Test {
 protected:
  ToySystemTest() {
    EXPECT_TRUE(prepare_matrix_products().ok());
    test::write_styles(folder_.path(), {"neutral", "old", "proud"}, 2);
    const auto rows = read_manifest(folder_.path() + "takes.csv", 0);
    for (const ManifestRow& row : *rows) {
      options_.training.push_back(row);
      if (row.test) options_.test.push_back(row);
    }
    options_.styles = {{"old", {"old"}, ""}, {"proud", {"proud"}, ""}};
    options_.models = {
        {"model", *Model::parse(format_safetensors(test::make_model({"old", "proud"})), "model")}};
    options_.systems.push_back({"toy", test::make_toy_system});
  }

  const test::TemporaryFolder folder_;
  EvaluateOptions options_;
};

TEST_F(ToySystemTest, a_folder_and_a_line_add_a_system_to_the_judge_and_to_all_reports) {
  const Result<Report> report = evaluate(options_);
  ASSERT_TRUE(report.ok()) << report.error().message;
  const Json systems = Json::parse(report_json(*report))["systems"];
  ASSERT_EQ(systems.size(), 3u);
  ASSERT_TRUE(systems.contains("model") && systems.contains("mean posture"));
  const Json& toy = systems.at("toy");
  // It bends forward, as the old do and the proud do not.
  EXPECT_GT(toy["seen_by_style"]["old"]["style_accuracy"], 0.9);
  EXPECT_LT(toy["seen_by_style"]["proud"]["style_accuracy"], 0.1);
  EXPECT_EQ(toy["strength"].size(), 9u);
  EXPECT_EQ(toy["strength"]["0"]["distance_cm"], 0.0);
  EXPECT_GT(toy["slider"]["distance"], 0.99);
  EXPECT_EQ(toy["mixes"].size(), 1u);
  EXPECT_TRUE(toy["cc"].is_number());
  // It has no answer for single instants, and nobody knows its size.
  EXPECT_TRUE(toy["seen"]["pose_error_cm"].is_null());
  EXPECT_TRUE(toy["disturbances"].empty());
  EXPECT_TRUE(toy["parameters"].is_null());
  EXPECT_TRUE(toy["recipe"].is_null());
  EXPECT_FALSE(toy.contains("recorded"));
  EXPECT_TRUE(systems["model"]["seen"]["pose_error_cm"].is_number());
  for (const std::string& text : {report_text(*report), report_page(*report)}) {
    EXPECT_NE(text.find("toy"), text.npos);
  }
}

}  // namespace
}  // namespace panache
