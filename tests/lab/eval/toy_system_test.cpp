// A system is added by a folder (eval/toy_system) and a line (in the constructor below).

#include "eval/toy_system/toy_system.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "eval/evaluate.h"
#include "make_model.h"
#include "make_styles.h"
#include "temporary_folder.h"
#include "train/matrix_products.h"

namespace panache {
namespace {

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
