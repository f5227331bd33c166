// panache-lab eval: what it reports and what it rejects.

#include <algorithm>
#include <filesystem>
#include <sstream>

#include <nlohmann/json.hpp>

#include "lab_program.h"
#include "make_styles.h"

namespace panache::test {
namespace {

using Json = nlohmann::json;

class Eval : public LabTest {
 protected:
  // Takes 0 and 1 of each style and content to learn from, 2 and 3 held out.
  void SetUp() override {
    ProgramTest::SetUp();
    write_styles(path(""), {"neutral", "old", "proud"}, 2);
  }
  std::string table(const std::string& rows) const {
    return "path,style,content,take,neutral,split\n" + rows;
  }
};

void expect_metrics(const Json& quality) {
  for (const char* key : {"takes", "windows", "style_accuracy", "content_accuracy", "jerk_ratio",
                          "skating_ratio", "skating_cm_s", "fmd"}) {
    ASSERT_TRUE(quality.contains(key)) << key;
    EXPECT_TRUE(quality[key].is_number()) << key;
  }
  EXPECT_GT(quality["takes"], 0);
}

void expect_system(const Json& system) {
  expect_metrics(system["seen"]);
  EXPECT_TRUE(system["seen"]["pose_error_cm"].is_number());
  for (const char* strength : {"0", "0.25", "0.5", "0.75", "1", "1.25", "1.5", "1.75", "2"}) {
    ASSERT_TRUE(system["strength"].contains(strength)) << strength;
    expect_metrics(system["strength"][strength]);
  }
  EXPECT_EQ(system["strength"].size(), 9u);
  for (const char* content : kContents) expect_metrics(system["seen_by_content"][content]);
  for (const char* style : {"old", "proud"}) expect_metrics(system["seen_by_style"][style]);
  // At strength 1, it is the same number by both names.
  EXPECT_EQ(system["strength"]["1"], system["seen"]);
  EXPECT_EQ(system["strength_by_style"].size(), 9u);
  EXPECT_EQ(system["strength_by_style"]["1"], system["seen_by_style"]);
  ASSERT_EQ(system["mixes"].size(), 1u);
  EXPECT_EQ(system["mixes"][0]["first"], "old");
  // No joint is ever drawn out: the clip's positions are single precision.
  EXPECT_LT(system["bone_length_error_cm"], 1e-2);
}

// One run answers all questions: to train the judges takes long.
TEST_F(Eval, judges_models_by_real_takes_it_holds_out_and_says_so_in_a_report) {
  const Ran ran = must(
      "eval takes.csv --model model.safetensors --system xia2015 --system yumer2016 "
      "--unseen-split wave --steps 20 --report report --json");
  EXPECT_EQ(ran.err, "");
  EXPECT_EQ(entries("report"), (std::vector<std::string>{"index.html", "report.json"}));
  EXPECT_EQ(read("report/report.json"), ran.out);
  EXPECT_TRUE(holds(read("report/index.html"), "<html"));

  const Json report = Json::parse(ran.out);
  EXPECT_EQ(report["styles"], Json({"old", "proud"}));
  EXPECT_EQ(report["contents"], Json({"walk", "wave"}));
  EXPECT_EQ(report["trained_on"], Json({"takes.csv"}));
  expect_metrics(report["real"]);
  EXPECT_EQ(report["real"]["takes"], 8);
  EXPECT_GT(report["real"]["style_accuracy"], 0.95);
  EXPECT_GT(report["real"]["content_accuracy"], 0.9);
  EXPECT_EQ(report["real"]["jerk_ratio"], 1.0);
  for (const char* content : kContents) expect_metrics(report["real_by_content"][content]);
  // Neutral takes are not of the styles, and have moved nowhere.
  expect_metrics(report["input"]);
  EXPECT_LT(report["input"]["style_accuracy"], 0.1);
  EXPECT_EQ(report["input"]["distance_cm"], 0.0);

  ASSERT_EQ(report["systems"].size(), 4u);
  for (const char* name : {"model", "mean posture", "xia2015", "yumer2016"}) {
    ASSERT_TRUE(report["systems"].contains(name)) << name;
    expect_system(report["systems"][name]);
  }
  for (const char* name : {"xia2015", "yumer2016"}) {
    const Json& system = report["systems"][name];
    EXPECT_GT(system["seen"]["style_accuracy"], 0.9) << name;
    EXPECT_LT(system["seen"]["pose_error_cm"], report["input"]["pose_error_cm"]) << name;
    EXPECT_EQ(system["strength"]["0"]["distance_cm"], 0.0) << name;
    EXPECT_TRUE(system["step_us"].is_number() && system["model_bytes"].is_number()) << name;
    expect_metrics(system["unseen_splits"]["wave"]["mean"]);
  }
  const Json& model = report["systems"]["model"];
  // Strength 0 is the input.
  EXPECT_EQ(model["strength"]["0"]["style_accuracy"], report["input"]["style_accuracy"]);
  EXPECT_NEAR(model["strength"]["0"]["distance_cm"].get<double>(), 0, 1e-3);
  EXPECT_GT(model["strength"]["1"]["distance_cm"], 0.5);
  EXPECT_EQ(model["model_bytes"], read("model.safetensors").size());
  // What bends all that it sees like its style is recognised as such.
  const Json& posture = report["systems"]["mean posture"];
  EXPECT_GT(posture["seen"]["style_accuracy"], 0.9);
  EXPECT_LT(posture["seen"]["pose_error_cm"], report["input"]["pose_error_cm"]);
  EXPECT_GT(posture["slider"]["distance"], 0.9);

  // One performer, whose judge knows all real takes, and most of what bends like them.
  EXPECT_EQ(report["performers"]["own"]["all"]["recognised"], 1);
  EXPECT_EQ(report["performers"]["own"]["all"]["clips"], 8);
  EXPECT_EQ(report["performers"]["own"]["confusion"]["neutral"], Json({{"neutral", 4}}));
  EXPECT_EQ(posture["performers"]["own"]["all"]["clips"], 8);
  EXPECT_GT(posture["performers"]["own"]["all"]["of_real"], 0.9);
  EXPECT_EQ(posture["performers"]["across"]["all"]["clips"], 0);
  EXPECT_TRUE(posture["performers"]["own"]["by_performer"].contains("takes"));

  expect_metrics(model["unseen"]["wave"]);
  EXPECT_FALSE(model["unseen"].contains("walk"));
  const Json& split = model["unseen_splits"]["wave"];
  expect_metrics(split["mean"]);
  expect_metrics(split["seen"]["wave"]);
  EXPECT_TRUE(split["blind"]["wave"]["style_accuracy"].is_number());
  expect_metrics(split["mean_posture"]["wave"]);
  for (const char* of : {"unseen", "mean_posture", "real", "blind"}) {
    EXPECT_EQ(split["performers"][of]["all"]["clips"], 4) << of;
    EXPECT_EQ(split["performers"][of]["by_content"].size(), 1u) << of;
  }
}

TEST_F(Eval, a_system_that_nobody_knows_is_rejected_with_those_that_there_are) {
  expect_rejected("eval takes.csv --system xia2016", 1,
                  "--system: no system 'xia2016'; expected all, xia2015, yumer2016 or holden2017");
}

// Our own outputs, made by the program as anybody's would be, judged beside the model itself.
TEST_F(Eval, outputs_of_another_program_are_judged_as_if_it_had_been_run) {
  std::filesystem::create_directories(path("theirs"));
  must("eval takes.csv --requests theirs/manifest.csv");
  const std::string manifest = read("theirs/manifest.csv");
  EXPECT_TRUE(begins(manifest,
                     "input,style,strength,output\n"
                     "\"neutral-walk-2.bvh\",\"old\",1,\"1_neutral-walk-2_old.bvh\"\n"
                     "\"neutral-walk-2.bvh\",\"proud\",1,\"2_neutral-walk-2_proud.bvh\"\n"));
  int count = 0;
  for (const std::string content : kContents) {
    for (const std::string take : {"2", "3"}) {
      for (const std::string style : {"old", "proud"}) {
        const std::string input = "neutral-" + content + "-" + take;
        const std::string output = std::to_string(++count) + "_" + input + "_" + style + ".bvh";
        ASSERT_NE(manifest.find("\"" + output + "\"\n"), manifest.npos) << manifest;
        const Ran made = run_panache({"stylize", input + ".bvh", "--style", style + "=1", "--model",
                                      "model.safetensors", "-o", "theirs/" + output});
        ASSERT_EQ(made.exit, 0) << made.err;
      }
    }
  }
  // A strength of which there is but one take.
  write("theirs/manifest.csv", manifest + "neutral-walk-2.bvh,old,0.5,1_neutral-walk-2_old.bvh\n");

  const Ran ran =
      must("eval takes.csv --model model.safetensors --recorded theirs --report report --json");
  const Json systems = Json::parse(ran.out)["systems"];
  EXPECT_EQ(systems.size(), 3u);
  const Json &theirs = systems.at("theirs"), &ours = systems.at("model");
  EXPECT_EQ(theirs["recorded"], Json({{"listed", 9}, {"judged", 9}}));
  EXPECT_FALSE(ours.contains("recorded"));
  EXPECT_EQ(theirs["seen"]["takes"], 8);
  EXPECT_EQ(theirs["strength"].size(), 2u);
  EXPECT_EQ(theirs["strength"]["0.5"]["takes"], 1);
  // The same motion but for the six decimals of the files, of which jerk is most sensitive. Heights
  // are another matter: a recorded output stands on the floor that its own file shows.
  EXPECT_EQ(theirs["seen"]["style_accuracy"], ours["seen"]["style_accuracy"]);
  EXPECT_NEAR(theirs["seen"]["jerk_ratio"], ours["seen"]["jerk_ratio"].get<double>(), 0.01);
  EXPECT_TRUE(theirs["seen"]["pose_error_cm"].is_null());
  EXPECT_TRUE(theirs["slider"]["style"].is_null());
  EXPECT_TRUE(theirs["mixes"].empty());
  EXPECT_EQ(theirs["recorded"], (Json{{"listed", 9}, {"judged", 9}}));

  // Who asks for outputs alone does not wait for training.
  const Ran alone = must("eval takes.csv --recorded theirs --json");
  const Json alone_systems = Json::parse(alone.out)["systems"];
  EXPECT_EQ(alone_systems.size(), 2u);
  EXPECT_TRUE(alone_systems.contains("theirs") && alone_systems.contains("mean posture"));
}

TEST_F(Eval, outputs_with_a_manifest_that_is_wrong_are_rejected_at_once) {
  write("theirs/manifest.csv", "input,style,strength,output\nneutral-walk-2.bvh,old,1,a.bvh\n");
  expect_rejected("eval takes.csv --model model.safetensors --recorded theirs", 1,
                  "theirs/manifest.csv:2: output theirs/a.bvh: cannot be read: No such file or "
                  "directory");
  expect_rejected("eval takes.csv --recorded theirs --recorded ./theirs/", 1,
                  "./theirs/: has the name of theirs; the report names outputs by their folder, so "
                  "give it another name");
  expect_rejected("eval takes.csv --requests theirs/manifest.csv", 1,
                  "theirs/manifest.csv: exists already; --force overwrites it");
}

TEST_F(Eval, without_test_takes_there_is_nothing_to_judge_by) {
  write("all.csv", table("neutral-walk-0.bvh,neutral,walk,0,1,train\n"
                         "old-walk-0.bvh,old,walk,0,0,train\n"));
  expect_rejected("eval all.csv --model model.safetensors", 1,
                  "all.csv: marks no take as test; mark some in its column split, or give a "
                  "manifest of test takes with --test");
}

TEST_F(Eval, takes_that_were_trained_on_or_are_of_other_styles_do_not_judge) {
  const std::string message =
      "others.csv: has no usable test take: all of them are trained on, or of styles that the "
      "training manifests do not have";
  const Words arguments = "eval takes.csv --test others.csv --model model.safetensors";
  // The same file by another way there.
  write("others.csv", table("./old-walk-0.bvh,old,walk,0,0,train\n"));
  expect_rejected(arguments, 1, message);
  write("others.csv", table("old-walk-2.bvh,jolly,walk,2,0,test\n"));
  expect_rejected(arguments, 1, message);
}

TEST_F(Eval, an_unknown_split_is_rejected) {
  expect_rejected("eval takes.csv --model model.safetensors --unseen-split walk,,wave", 1,
                  "--unseen-split: split 'walk,,wave'; expected A, B or C, or different contents "
                  "with commas between them");
}

TEST_F(Eval, a_report_that_exists_is_kept) {
  write("report/report.json", "mine");
  expect_rejected("eval takes.csv --model model.safetensors --report report", 1,
                  "report/report.json: exists already; --force overwrites it");
  EXPECT_EQ(read("report/report.json"), "mine");
}

TEST_F(Eval, two_models_of_one_name_are_rejected) {
  write("other/model.safetensors", read("model.safetensors"));
  expect_rejected("eval takes.csv --model model.safetensors --model other/model.safetensors", 1,
                  "other/model.safetensors: has the name of model.safetensors; the report names "
                  "models by their files, so give one another name");
}

// Two styles of which training takes say the opposite of test takes: no classifier can know them.
TEST_F(Eval, figures_come_also_where_the_classifier_does_not_know_real_takes) {
  std::istringstream lines(read("takes.csv"));
  std::string rows;
  for (std::string line; std::getline(lines, line);) {
    const size_t old = line.find(",old,"), proud = line.find(",proud,");
    if (line.ends_with("train") && old != line.npos) line.replace(old, 5, ",proud,");
    if (line.ends_with("train") && proud != line.npos) line.replace(proud, 7, ",old,");
    rows += line + "\n";
  }
  write("exchanged.csv", rows);
  const Ran ran = must("eval exchanged.csv --model model.safetensors --report report --json");
  const Json report = Json::parse(ran.out);
  EXPECT_LT(report["real"]["style_accuracy"], 0.5);
  ASSERT_EQ(report["notes"].size(), 1u);
  const std::string note = report["notes"][0];
  EXPECT_TRUE(begins(note, "The style classifier recognises 0."));
  EXPECT_TRUE(holds(note, "of the windows of real held-out takes, less than 0.950"));
  EXPECT_TRUE(holds(read("report/index.html"), note));
  const Json& seen = report["systems"]["model"]["seen"];
  for (const char* key :
       {"pose_error_cm", "pose_error_deg", "jerk_ratio", "skating_cm_s", "cadence_ratio"}) {
    EXPECT_TRUE(seen[key].is_number()) << key;
  }
}

TEST_F(Eval, a_manifest_or_model_that_is_none_is_explained) {
  expect_rejected("eval none.csv", 1, "none.csv: cannot be read: No such file or directory");
  expect_rejected("eval takes.csv --model takes.csv", 1,
                  "takes.csv: does not start with the length of a header (at most 4194304 bytes); "
                  "expected a safetensors file, as models and styles are");
  EXPECT_EQ(run("eval takes.csv --steps 0").exit, 2);
}

}  // namespace
}  // namespace panache::test
