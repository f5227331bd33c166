#include "eval/report.h"

#include <fstream>
#include <limits>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/file.h"
#include "eval/make_report.h"
#include "takes/signature.h"
#include "temporary_folder.h"

namespace panache {
namespace {

using Json = nlohmann::json;
using test::kRude;
using test::made_up_report;
using test::numbers;

std::string bytes_of(const std::string& path) {
  const Result<std::string> bytes = read_file(path);
  return bytes.ok() ? *bytes : bytes.error().message;
}

TEST(ReportJson, every_number_stands_under_its_key) {
  Json json = Json::parse(report_json(made_up_report()));
  EXPECT_EQ(json["format"], "panache report 1");
  EXPECT_EQ(json["trained_on"], Json({"one.csv"}));
  EXPECT_EQ(json["styles"], Json({"old", "proud"}));
  EXPECT_EQ(json["seconds"], 427);
  EXPECT_EQ(json["style_floor"], 0.95);
  EXPECT_EQ(json["cc_floor"], 4.25);
  Json& system = json["systems"]["panache"];
  struct {
    Json found;
    double seed;
  } expected_numbers[] = {
      {json["real"], 0.97},
      {json["input"], 0.02},
      {json["real_by_content"]["run"], 0.96},
      {json["real_by_style"]["old"], 0.95},
      {json["input_by_content"]["walk"], 0.03},
      {system["seen"], 0.8},
      {system["seen_by_content"]["run"], 0.8 + 0.02},
      {system["seen_by_style"]["old"], 0.8 + 0.03},
      {system["strength"]["0.25"], 0.04},
      {system["strength"]["2"], 0.8 + 0.05},
      {system["unseen_splits"]["A"]["mean"], 0.61},
      {system["unseen_splits"]["A"]["run"], 0.62},
      {system["unseen_splits"]["A"]["seen"]["run"], 0.63},
      {system["unseen_splits"]["A"]["blind"]["run"], 0.64},
      {system["unseen_splits"]["A"]["mean_posture"]["run"], 0.65},
      {system["unseen_splits"]["B"]["walk"], 0.68},
  };
  for (auto& [found, seed] : expected_numbers) {
    const Metrics expected = numbers(seed);
    EXPECT_EQ(found["takes"], expected.takes);
    EXPECT_EQ(found["windows"], expected.windows);
    for (const Measure& measure : measures()) {
      ASSERT_TRUE(found.contains(measure.key)) << seed << " " << measure.key;
      EXPECT_EQ(found[measure.key].get<double>(), expected[measure.key])
          << seed << " " << measure.key;
    }
  }
  EXPECT_EQ(system["recipe"], "panache");
  EXPECT_EQ(system["slider"]["style"], 0.97);
  EXPECT_EQ(system["slider"]["distance"], 0.99);
  EXPECT_EQ(system["mixes"][0]["either"], 0.81);
  EXPECT_EQ(system["mixes"][0]["second"], "proud");
  EXPECT_EQ(system["disturbances"]["floor -5 cm"]["cm"], 2.75);
  EXPECT_EQ(system["foresight"]["walk"]["instants"], 100);
  EXPECT_EQ(system["foresight"]["walk"]["0.10"]["predicted_cm"], 1.25);
  EXPECT_EQ(system["foresight"]["walk"]["0.10"]["velocity_cm"], 4.5);
  EXPECT_EQ(system["foresight"]["walk"]["0.25"]["held_cm"], 30.5);
  const Json& persons = system["persons"];
  EXPECT_EQ(persons["real"]["people"], 29);
  EXPECT_EQ(persons["real"]["median_cm"], 4.125);
  EXPECT_EQ(persons["real"]["told"], 0.875);
  EXPECT_EQ(persons["seeds"]["p90_cm"], 6.5);
  EXPECT_EQ(persons["seeds"]["outside"], 0.04);
  EXPECT_EQ(persons["styled"]["told"], 0.9375);
  EXPECT_EQ(persons["styled"]["told_without"], 0.96875);
  EXPECT_EQ(persons["others"]["jerk_p90"], 1.03);
  EXPECT_EQ(persons["others"]["more_sliding"], 0.001);
  EXPECT_TRUE(json["systems"][kRude]["persons"].is_null());
  EXPECT_EQ(system["cc"], 8.5);
  EXPECT_EQ(system["sc"], 63);
  EXPECT_EQ(system["bone_length_error_cm"], 0.002);
  EXPECT_EQ(system["step_us"], 6.5);
  EXPECT_EQ(system["model_bytes"], 868352);
  EXPECT_EQ(system["parameters"], 216412);
  EXPECT_TRUE(json["systems"].contains(kRude));
}

TEST(ReportJson, it_says_how_measures_and_traits_are_called_and_read) {
  const Json json = Json::parse(report_json(Report()));
  ASSERT_EQ(json["measures"].size(), measures().size());
  for (size_t m = 0; m < measures().size(); ++m) {
    EXPECT_EQ(json["measures"][m]["key"], measures()[m].key);
    EXPECT_EQ(json["measures"][m]["label"], measures()[m].label);
    EXPECT_EQ(json["measures"][m]["digits"], measures()[m].digits);
    EXPECT_EQ(json["measures"][m]["meaning"], measures()[m].meaning);
  }
  const auto better = [&](const char* key) {
    for (const Json& measure : json["measures"]) {
      if (measure["key"] == key) return measure["better"].get<std::string>();
    }
    return std::string();
  };
  EXPECT_EQ(better("style_accuracy"), "higher");
  EXPECT_EQ(better("pose_error_cm"), "lower");
  EXPECT_EQ(better("jerk_ratio"), "nearest_one");
  ASSERT_EQ(json["traits"].size(), kTraits.size());
  EXPECT_EQ(json["traits"][0], Json({{"key", "lean"}, {"label", "lean forward, degrees"}}));
}

TEST(ReportJson, the_means_of_a_split_stand_beside_it) {
  const Json json = Json::parse(report_json(made_up_report()));
  const Json& split = json["systems"]["panache"]["unseen_splits"]["A"];
  EXPECT_EQ(split["contents"], Json({"run"}));
  EXPECT_EQ(split["means"]["seen"], split["seen"]["run"]);  // Of one content.
  EXPECT_EQ(split["means"]["blind"], split["blind"]["run"]);
  EXPECT_EQ(split["means"]["mean_posture"], split["mean_posture"]["run"]);
  EXPECT_TRUE(json["systems"]["panache"]["unseen_splits"]["B"]["means"]["seen"]["fmd"].is_null());
}

TEST(ReportJson, styles_of_a_performer_stand_together_in_confusions) {
  const Json json = Json::parse(report_json(made_up_report()));
  EXPECT_EQ(json["performers"]["labels"], Json({"neutral", "old", "proud"}));
}

TEST(ReportJson, a_planted_foot_is_a_span_of_frames) {
  Report report;
  ContactRow row{"input", 10, std::vector<FootContacts>(40)};
  for (size_t f = 0; f < 40; ++f) row.contacts[f] = {f < 20, (f >= 5 && f < 10) || f >= 35};
  report.contacts = {{"walk", {row}}};
  const Json json = Json::parse(report_json(report));
  EXPECT_EQ(json["contacts"], Json::parse(R"([{"title": "walk", "rows": [{"label": "input",
      "fps": 10, "frames": 40, "left": [[0, 20]], "right": [[5, 10], [35, 40]]}]}])"));
}

TEST(ReportJson, an_unseen_content_is_that_of_the_first_split_that_has_it) {
  Json json = Json::parse(report_json(made_up_report()));
  Json& unseen = json["systems"]["panache"]["unseen"];
  EXPECT_EQ(unseen["run"]["style_accuracy"].get<double>(), numbers(0.62)["style_accuracy"]);
  EXPECT_EQ(unseen["walk"]["style_accuracy"].get<double>(), numbers(0.68)["style_accuracy"]);
}

TEST(ReportJson, clips_before_judges_of_performers_are_summed_up) {
  Json json = Json::parse(report_json(made_up_report()));
  Json& real = json["performers"]["own"];
  EXPECT_EQ(real["all"]["clips"], 4);  // Neutral is no style,
  EXPECT_EQ(real["all"]["recognised"], 0.75);
  EXPECT_EQ(real["by_style"]["neutral"]["clips"], 1);  // but it may be taken for one.
  EXPECT_EQ(real["by_style"]["old"]["cm"], 2.5);
  EXPECT_FALSE(real["all"].contains("of_real"));
  EXPECT_EQ(real["confusion"]["old"], Json({{"neutral", 1}, {"old", 1}}));
  Json& own = json["systems"]["panache"]["performers"]["own"];
  EXPECT_EQ(own["by_style"]["old"]["recognised"], 0.5);
  EXPECT_EQ(own["by_style"]["old"]["of_real"], 1);
  EXPECT_EQ(own["by_style"]["old"]["cm"], 7.25);
  EXPECT_DOUBLE_EQ(own["by_style"]["old"]["hand_sharpness"], 1);  // Half and twice.
  EXPECT_NEAR(own["all"]["of_real"], 2 / 3.0 / 0.75, 1e-12);
  EXPECT_EQ(own["by_performer"]["bob"]["clips"], 1);
  // Both ann and bob are proud; only ann is old.
  EXPECT_EQ(json["performers"]["shared"]["all"]["clips"], 2);
  EXPECT_EQ(json["systems"]["panache"]["performers"]["shared"]["all"]["clips"], 1);
  Json& across = json["systems"]["panache"]["performers"]["across"];
  EXPECT_EQ(across["by_style"]["old"]["recognised"], 1);
  EXPECT_TRUE(across["by_style"]["old"]["of_real"].is_null());  // No real take of another.
  EXPECT_TRUE(across["all"]["cm"].is_null());
  Json& unseen = json["systems"]["panache"]["unseen_splits"]["A"]["performers"];
  EXPECT_EQ(unseen["unseen"]["by_content"]["run"]["hand_speed"], 1.25);
  EXPECT_EQ(unseen["unseen"]["all"]["of_real"], 1);
  EXPECT_EQ(unseen["mean_posture"]["all"]["recognised"], 0);
  EXPECT_EQ(unseen["blind"]["all"]["recognised"], 0);
}

TEST(ReportJson, out_of_distribution_rows_are_kept_and_summed_up) {
  Json json = Json::parse(report_json(made_up_report()));
  Json& ood = json["systems"]["panache"]["foreign"];
  ASSERT_EQ(ood["rows"].size(), 11u);
  EXPECT_EQ(ood["by_clip"]["dance"]["distance_cm"], 2.5);  // The mean of 0 to 5.
  EXPECT_EQ(ood["by_clip"]["box"]["distance_cm"], 8);
  EXPECT_EQ(ood["rows"][3]["clip"], "dance");
  EXPECT_EQ(ood["rows"][3]["beyond_limits"], 0.11);
  Json& summary = ood["summary"];
  EXPECT_EQ(summary["clips"], 2);
  EXPECT_EQ(summary["rows"], 11);
  // Eleven rows in equal steps: median, 90 % and 10 % are the sixth, tenth and second.
  EXPECT_DOUBLE_EQ(summary["jerk_ratio"]["median"], 1.5);
  EXPECT_DOUBLE_EQ(summary["jerk_ratio"]["p90"], 1.9);
  EXPECT_DOUBLE_EQ(summary["jerk_ratio"]["max"], 2.0);
  EXPECT_DOUBLE_EQ(summary["velocity_correlation"]["median"], 0.7);
  EXPECT_DOUBLE_EQ(summary["velocity_correlation"]["p10"], 0.54);
  EXPECT_DOUBLE_EQ(summary["distance_cm"]["mean"], 5);
  EXPECT_DOUBLE_EQ(summary["beyond_limits"]["mean"], 0.01);
  EXPECT_DOUBLE_EQ(summary["beyond_limits"]["max"], 0.11);
  EXPECT_EQ(summary["beyond_limits"]["rows"], 1);
  EXPECT_DOUBLE_EQ(summary["under_floor"]["mean"], 0.04);
  EXPECT_EQ(summary["under_floor"]["rows"], 2);
  EXPECT_EQ(summary["jumps"]["frames"], 6);
  EXPECT_EQ(summary["jumps"]["rows"], 3);
  EXPECT_DOUBLE_EQ(summary["turned_deg"]["mean"], 5);
  EXPECT_DOUBLE_EQ(summary["drift_m"]["max"], 3.0);
  EXPECT_DOUBLE_EQ(summary["gate"]["mean"], 0.5);
  const Json& shot = ood["shot"]["seat_hips"];  // 0, 1 ... 10.
  EXPECT_EQ(shot["frames"], 11);
  EXPECT_DOUBLE_EQ(shot["median"], 5);
  EXPECT_DOUBLE_EQ(shot["p90"], 9);
  EXPECT_NEAR(shot["over_2"], 8 / 11.0, 1e-4);
  EXPECT_EQ(ood["shot"]["hands"]["median"], nullptr);
}

OodRow judged(const std::string& clip, int style, std::vector<double> scores) {
  OodRow row;
  row.clip = clip;
  row.style = style == 0 ? "old" : "proud";
  row.verdict.style = style;
  row.verdict.style_robust = 0.25;
  row.verdict.style_lda = 0.75;
  row.verdict.robust_scores = scores;
  row.verdict.lda_scores = {scores[1], scores[0]};
  row.verdict.signature.traits = 4;
  row.verdict.signature.sign = 3;
  row.verdict.signature.amount = 2;
  row.verdict.signature.takes = 1;
  row.verdict.signature.change[0] = 5 + style;
  return row;
}

TEST(ReportJson, styles_of_out_of_distribution_rows_are_judged_in_four_ways_and_by_signature) {
  Report report = made_up_report();
  // Both judges like "old" best throughout; beyond that the first tells the outputs apart, and the
  // second takes each for the other.
  report.systems[0].ood = {judged("box", 0, {5, 1}), judged("box", 1, {4, 2}),
                           judged("jump", 0, {3, 1}), judged("jump", 1, {2.5, 1})};
  Json json = Json::parse(report_json(report));
  Json& summary = json["systems"]["panache"]["foreign"]["summary"];
  EXPECT_EQ(summary["style_robust"], 0.25);
  EXPECT_EQ(summary["style_lda"], 0.75);
  EXPECT_EQ(summary["forced_mlp"], 1);
  EXPECT_EQ(summary["forced_lda"], 0);
  EXPECT_EQ(summary["signature_sign"], 0.75);
  EXPECT_EQ(summary["signature_amount"], 0.5);
  Json& signatures = json["systems"]["panache"]["foreign"]["signatures"];
  EXPECT_EQ(signatures["old"]["lean"], 5);
  EXPECT_EQ(signatures["proud"]["lean"], 6);
  EXPECT_EQ(signatures["proud"]["sign"], 0.75);
  EXPECT_TRUE(json["systems"][kRude]["foreign"]["summary"]["forced_lda"].is_null());
}

TEST(ReportJson, what_was_not_measured_is_null) {
  Report report = made_up_report();
  report.real["fmd"] = kNotMeasured;
  report.real["jerk_ratio"] = std::numeric_limits<double>::infinity();
  report.systems[0].slider_style = kNotMeasured;
  report.systems[0].ood.clear();
  report.systems[0].model_bytes = 0;
  report.systems[0].recipe.clear();
  Json json = Json::parse(report_json(report));
  EXPECT_TRUE(json["real"].at("fmd").is_null());
  EXPECT_TRUE(json["real"].at("jerk_ratio").is_null());
  Json& system = json["systems"]["panache"];
  EXPECT_TRUE(system["slider"].at("style").is_null());
  EXPECT_TRUE(system["foreign"]["summary"]["jerk_ratio"].at("median").is_null());
  EXPECT_TRUE(system.at("model_bytes").is_null());
  EXPECT_TRUE(system.at("recipe").is_null());
}

TEST(ReportJson, a_name_that_is_no_text_does_not_lose_the_report) {
  Report report = made_up_report();
  report.systems[0].name = "caf\xe9";
  EXPECT_TRUE(Json::accept(report_json(report)));
}

TEST(WriteReport, both_files_are_written_into_a_folder_that_is_made) {
  const test::TemporaryFolder temporary;
  const std::string folder = temporary.path() + "new/report";
  const Report report = made_up_report();
  // Twice: an old report is replaced.
  for (int i = 0; i < 2; ++i) {
    const Result<void> written = write_report(report, folder);
    ASSERT_TRUE(written.ok()) << written.error().message;
  }
  EXPECT_EQ(bytes_of(folder + "/report.json"), report_json(report));
  EXPECT_EQ(bytes_of(folder + "/index.html"), report_page(report));
}

TEST(WriteReport, a_file_in_the_place_of_the_folder_is_rejected) {
  const test::TemporaryFolder temporary;
  const std::string path = temporary.path() + "taken";
  std::ofstream(path) << "mine";
  EXPECT_EQ(write_report(Report(), path).error().message,
            path + ": is a file; expected a folder to write the report into");
  EXPECT_EQ(write_report(Report(), path + "/deeper").error().message,
            path + "/deeper: cannot be made; expected a place where a folder may be written");
  EXPECT_EQ(bytes_of(path), "mine");
}

}  // namespace
}  // namespace panache
