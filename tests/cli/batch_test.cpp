// Many files at once: folders, patterns, and the account at the end.

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <map>
#include <sstream>

#include <sys/stat.h>

#include <nlohmann/json.hpp>

#include "cli/program.h"

namespace panache::test {
namespace {

class Batch : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    write_walk("takes/b.bvh");
    write_walk("takes/a.bvh");
    write_walk("takes/day 2/a.bvh");
    write_walk("takes/day 2/deep/C.BVH");
    write("takes/notes.txt", "not a motion");
    write("takes/.hidden.bvh", "not a motion");
    write("takes/.git/x.bvh", "not a motion");
  }
  Ran stylize(const Words& arguments) { return run("stylize --style old=1" + arguments); }
  // What the report says each input became.
  std::vector<std::string> pairs(Words arguments) {
    arguments.emplace_back("--json");
    const Ran ran = stylize(std::move(arguments));
    EXPECT_EQ(ran.exit, 0) << ran.err;
    std::vector<std::string> out;
    for (const auto& file : nlohmann::json::parse(ran.out)) {
      EXPECT_TRUE(exists(file["out"].get<std::string>()));
      out.push_back(file["in"].get<std::string>() + " > " + file["out"].get<std::string>());
    }
    return out;
  }
  using Lines = std::vector<std::string>;
  using Json = nlohmann::json;
  std::vector<Json> report(const std::string& name) {
    std::vector<Json> out;
    std::istringstream lines(read(name));
    for (std::string line; std::getline(lines, line);) out.push_back(Json::parse(line));
    return out;
  }
};

TEST_F(Batch, a_folder_means_all_motion_in_it_and_keeps_its_folders) {
  EXPECT_EQ(pairs("takes -o out"), (Lines{"takes/a.bvh > out/a.bvh", "takes/b.bvh > out/b.bvh",
                                          "takes/day 2/a.bvh > out/day 2/a.bvh",
                                          "takes/day 2/deep/C.BVH > out/day 2/deep/C.BVH"}));
}

TEST_F(Batch, inputs_are_files_folders_and_patterns_each_file_once) {
  write_walk("a[1].bvh");
  const std::pair<Words, Lines> cases[] = {
      {{"takes/day 2/deep/", "-o", "folder"}, {"takes/day 2/deep/C.BVH > folder/C.BVH"}},
      {"takes/*.bvh -o one", {"takes/a.bvh > one/a.bvh", "takes/b.bvh > one/b.bvh"}},
      {"takes/**/[ac].* -o any",
       {"takes/a.bvh > any/a.bvh", "takes/day 2/a.bvh > any/day 2/a.bvh"}},
      {"takes/day?2/** -o below",
       {"takes/day 2/a.bvh > below/day 2/a.bvh",
        "takes/day 2/deep/C.BVH > below/day 2/deep/C.BVH"}},
      {"a[1].bvh -o name/", {"a[1].bvh > name/a[1].bvh"}},
      {"takes/*.bvh takes/a.bvh ./takes/b.bvh -o twice",
       {"takes/a.bvh > twice/a.bvh", "takes/b.bvh > twice/b.bvh"}},
  };
  for (const auto& [arguments, expected] : cases) EXPECT_EQ(pairs(arguments), expected);
}

TEST_F(Batch, results_are_no_inputs) {
  EXPECT_EQ(pairs("takes -o takes/old").size(), 4u);
  EXPECT_EQ(pairs("takes -o takes/old --force").size(), 4u);
}

TEST_F(Batch, what_is_done_already_can_be_skipped) {
  ASSERT_EQ(stylize("takes/a.bvh -o out/").exit, 0);
  write("out/b.bvh", "mine");
  const std::string a = read("out/a.bvh");
  const Ran rest = stylize("takes -o out --skip-existing");
  EXPECT_EQ(rest.exit, 0) << rest.err;
  EXPECT_TRUE(begins(rest.out, "restyled 2 of 4 files, 2 skipped, in "));
  EXPECT_EQ(read("out/a.bvh"), a);
  EXPECT_EQ(read("out/b.bvh"), "mine");
  EXPECT_TRUE(exists("out/day 2/deep/C.BVH"));
  write("takes/broken.bvh", "nothing");
  const Ran more = stylize("takes -o out --skip-existing");
  EXPECT_TRUE(begins(more.out, "restyled 0 of 5 files, 1 failed, 4 skipped, in "));
  const Ran one = stylize("takes/b.bvh -o out/b.bvh --skip-existing");
  EXPECT_EQ(one.out, "skipped takes/b.bvh: out/b.bvh exists already\n");
  EXPECT_EQ(one.exit, 0);
  EXPECT_EQ(stylize("takes -o out --skip-existing --force").exit, 2);
}

TEST_F(Batch, what_another_process_wrote_meanwhile_is_skipped) {
  for (int i = 0; i < 100; ++i) write_walk("many/" + std::to_string(i) + ".bvh", 8);
  const pid_t batch = start("stylize many --style old=1 -o out --skip-existing");
  while (!exists("out")) ::usleep(100);
  Lines theirs;
  for (int i = 0; i < 100; ++i) {
    const std::string name = "out/" + std::to_string(i) + ".bvh";
    if (write_file(path(name), "theirs", false)) theirs.push_back(name);
  }
  const Ran ran = finish(batch);
  EXPECT_EQ(ran.exit, 0) << ran.err;
  ASSERT_FALSE(theirs.empty());
  EXPECT_TRUE(begins(ran.out, "restyled " + std::to_string(100 - theirs.size()) +
                                  " of 100 files, " + std::to_string(theirs.size()) +
                                  " skipped, in "));
  for (const std::string& name : theirs) EXPECT_EQ(read(name), "theirs");
}

TEST_F(Batch, a_dry_run_shows_what_would_be_written_and_writes_nothing) {
  const Ran ran = stylize("takes/a.bvh takes/b.bvh -o out --dry-run");
  EXPECT_EQ(ran.exit, 0) << ran.err;
  EXPECT_EQ(ran.out,
            "would write out/a.bvh from takes/a.bvh\nwould write out/b.bvh from takes/b.bvh\n");
  EXPECT_FALSE(exists("out"));
  write("out/b.bvh", "mine");
  EXPECT_EQ(stylize("takes/b.bvh -o out/ --dry-run --skip-existing").out,
            "would skip takes/b.bvh: out/b.bvh exists already\n");
  const Ran taken = stylize("takes/b.bvh -o out/ --dry-run");
  EXPECT_EQ(taken.err, "panache: out/b.bvh: exists already; --force overwrites it\n");
  const auto plan = nlohmann::json::parse(stylize("takes/a.bvh -o out/ --dry-run --json").out);
  EXPECT_EQ(plan[0]["out"], "out/a.bvh");
}

TEST_F(Batch, quiet_prints_errors_alone) {
  write("takes/bad.bvh", "HIERARCHY");
  const Ran ran = stylize("takes -o out --quiet");
  EXPECT_EQ(ran.exit, 1);
  EXPECT_EQ(ran.out, "");
  EXPECT_TRUE(begins(ran.err, "panache: takes/bad.bvh:"));
  EXPECT_EQ(std::count(ran.err.begin(), ran.err.end(), '\n'), 1) << ran.err;
  EXPECT_TRUE(exists("out/a.bvh"));
  const Ran good = stylize("takes/a.bvh -o a.bvh --quiet");
  EXPECT_EQ(good.out + good.err, "");
}

TEST_F(Batch, a_link_to_a_folder_is_not_followed) {
  std::filesystem::create_directory_symlink("..", path("takes/up"));
  EXPECT_EQ(pairs("takes -o out").size(), 4u);
}

TEST_F(Batch, existing_outputs_are_rejected_together_before_any_work) {
  EXPECT_EQ(stylize("takes -o out").exit, 0);
  const Ran all = stylize("takes -o out");
  EXPECT_EQ(all.exit, 1);
  EXPECT_EQ(all.err,
            "panache: 4 of 4 outputs exist already (out/a.bvh, out/b.bvh, out/day 2/a.bvh and 1 "
            "more); --force overwrites them\n");
  std::filesystem::remove(path("out/a.bvh"));
  std::filesystem::remove(path("out/b.bvh"));
  EXPECT_EQ(
      stylize("takes -o out").err,
      "panache: 2 of 4 outputs exist already (out/day 2/a.bvh, out/day 2/deep/C.BVH); --force "
      "overwrites them\n");
  EXPECT_FALSE(exists("out/a.bvh"));
  EXPECT_EQ(stylize("takes -o out --force").exit, 0);
}

TEST_F(Batch, a_file_that_fails_stops_no_other) {
  write("takes/day 2/bad.bvh", "HIERARCHY\n");
  const Ran ran = stylize("takes -o out");
  EXPECT_EQ(ran.exit, 1);
  EXPECT_TRUE(begins(ran.err, "panache: takes/day 2/bad.bvh:"));
  EXPECT_EQ(std::count(ran.err.begin(), ran.err.end(), '\n'), 1) << ran.err;
  EXPECT_TRUE(begins(ran.out, "restyled 4 of 5 files, 1 failed, in "));
  EXPECT_EQ(entries("out/day 2"), (Lines{"a.bvh", "deep"}));
}

TEST_F(Batch, a_report_has_a_line_for_each_file) {
  write("takes/bad.bvh", "");
  const Ran ran = stylize("takes/*.bvh -o out --report new/report.jsonl --json");
  EXPECT_EQ(ran.exit, 1);
  const std::vector<Json> lines = report("new/report.jsonl");
  ASSERT_EQ(lines.size(), 4u);
  EXPECT_EQ(lines[0]["of"]["verb"], "stylize");
  EXPECT_EQ(lines[0]["of"]["options"], (Json{{"--style", {"old=1"}}}));
  EXPECT_EQ(lines[0]["of"]["model"]["file"], "model.safetensors");
  std::map<std::string, Json> by_input;
  for (const Json& line : lines) by_input[line.value("in", "")] = line;
  Json good = by_input["takes/a.bvh"];
  EXPECT_EQ(good["out"], "out/a.bvh");
  EXPECT_EQ(good["ok"], true);
  EXPECT_EQ(good["settings"], lines[0]["settings"]);
  EXPECT_EQ(good["frames"], good["clips"][0]["frames_out"]);
  EXPECT_EQ(good["seconds"], good["clips"][0]["seconds"]);
  EXPECT_FALSE(good.contains("mapping"));
  EXPECT_LT(good.dump().size(), 500u);
  const Json bad = by_input["takes/bad.bvh"];
  EXPECT_EQ(bad["ok"], false);
  EXPECT_EQ("panache: " + bad["error"].get<std::string>() + "\n", ran.err);
  EXPECT_EQ(bad["clips"].size(), 0u);
  // What is printed has the same, and the mapping.
  const auto printed = Json::parse(ran.out);
  ASSERT_EQ(printed.size(), 3u);
  EXPECT_EQ(printed[0]["mapping"]["up_axis"], "+Y");
  EXPECT_EQ(printed[0]["clips"][0]["styles"][0]["name"], "old");
  stylize("takes/a.bvh -o y.bvh --report mapped.jsonl --mapping");
  EXPECT_EQ(report("mapped.jsonl").at(1)["mapping"]["up_axis"], "+Y");
  const Ran again = stylize("takes/a.bvh -o x.bvh --report new/report.jsonl");
  EXPECT_EQ(again.err, "panache: new/report.jsonl: exists already; --force overwrites it\n");
  const Ran same = stylize("takes/a.bvh -o x.bvh --report x.bvh");
  EXPECT_EQ(same.err, "panache: --report: x.bvh is an output too; expected a separate file\n");
  EXPECT_EQ(same.exit, 2);
}

TEST_F(Batch, a_report_grows_while_the_batch_works) {
  for (int i = 0; i < 200; ++i) write_walk("many/" + std::to_string(i) + ".bvh", 40);
  const pid_t batch = start("stylize many --style old=1 -o out --jobs 1 --report report.jsonl");
  while (!exists("report.jsonl") || report("report.jsonl").size() < 3) ::usleep(1000);
  EXPECT_LT(entries("out").size(), 200u) << "the report came at the end";
  EXPECT_EQ(finish(batch).exit, 0);
  EXPECT_EQ(report("report.jsonl").size(), 201u);
}

TEST_F(Batch, outputs_of_other_settings_are_not_taken_for_done) {
  EXPECT_EQ(stylize("takes -o out --report r.jsonl").exit, 0);
  EXPECT_EQ(stylize("takes -o out --report r.jsonl --skip-existing").exit, 0);
  std::filesystem::remove(path("out/a.bvh"));
  const Ran rest = stylize("takes -o out --report r.jsonl --skip-existing");
  EXPECT_TRUE(begins(rest.out, "restyled 1 of 4 files, 3 skipped, in "));
  // What is printed is no setting.
  EXPECT_EQ(stylize("takes -o out --report r.jsonl --skip-existing --verbose").exit, 0);
  const Words others = "takes -o out --report r.jsonl --skip-existing --style proud=1";
  const std::string expected =
      "panache: out/a.bvh and 3 more: made with other settings, as r.jsonl says: options "
      "{\"--style\":[\"old=1\"]} instead of {\"--style\":[\"old=1\",\"proud=1\"]}; --force makes "
      "them "
      "again\n";
  EXPECT_EQ(stylize(others).err, expected);
  // Another model under the same name is another setting.
  write("model.safetensors", read("model.safetensors") + " ");
  const Ran model = stylize("takes/a.bvh -o out/a.bvh --report r.jsonl --skip-existing");
  EXPECT_NE(model.exit, 0);
}

TEST_F(Batch, files_are_named_by_a_list) {
  write("list.txt", "takes/day 2/a.bvh\r\n\ntakes/b.bvh\n./takes/b.bvh");
  EXPECT_EQ(pairs("--files-from list.txt --below takes -o out"),
            (Lines{"takes/day 2/a.bvh > out/day 2/a.bvh", "takes/b.bvh > out/b.bvh"}));
  EXPECT_EQ(pairs("--files-from list.txt -o flat"),
            (Lines{"takes/day 2/a.bvh > flat/a.bvh", "takes/b.bvh > flat/b.bvh"}));
  EXPECT_EQ(
      pairs({"--files-from", "list.txt", "--below", path("."), "-o", "whole"}),
      (Lines{"takes/day 2/a.bvh > whole/takes/day 2/a.bvh", "takes/b.bvh > whole/takes/b.bvh"}));
  const Ran beside = stylize({"--files-from", "list.txt", "--below", "takes/day 2", "-o", "x"});
  EXPECT_EQ(beside.err, "panache: list.txt:3: takes/b.bvh is not below takes/day 2\n");
  const Ran both = stylize("takes/a.bvh --files-from list.txt -o x");
  EXPECT_EQ(both.err, "panache: --files-from: expected no other inputs, found takes/a.bvh\n");
  write("empty.txt", "\n");
  EXPECT_EQ(stylize("--files-from empty.txt -o x").err, "panache: empty.txt: names no file\n");
}

TEST_F(Batch, shards_share_out_the_files) {
  std::vector<std::string> all;
  for (const char* shard : {"1/3", "2/3", "3/3"}) {
    for (const std::string& pair : pairs({"takes", "-o", "out", "--shard", shard})) {
      all.push_back(pair);
    }
  }
  std::sort(all.begin(), all.end());
  EXPECT_EQ(all, pairs("takes -o out --force"));
  const Ran none = stylize("takes -o out --shard 9/9");
  EXPECT_EQ(none.exit, 0);
  EXPECT_TRUE(begins(none.out, "restyled 0 of 0 files in "));
  for (const char* wrong : {"0/3", "4/3", "1", "1/", "a/b", "1/3x", "-1/3"}) {
    const Ran ran = stylize({"takes", "-o", "out", "--shard", wrong});
    EXPECT_EQ(ran.exit, 2);
    EXPECT_EQ(ran.err, "panache: --shard '" + std::string(wrong) +
                           "': expected I/N with I from 1 to N, such as 2/8\n");
  }
}

TEST_F(Batch, one_file_needs_no_output_name) {
  const Ran ran = stylize("takes/a.bvh --style proud=0.5");
  EXPECT_EQ(ran.exit, 0) << ran.err;
  EXPECT_TRUE(begins(ran.out, "restyled takes/a.bvh into takes/a-old-proud.bvh ("));
  EXPECT_TRUE(exists("takes/a-old-proud.bvh"));
  EXPECT_EQ(stylize("takes/a.bvh --style proud=0.5").err,
            "panache: takes/a-old-proud.bvh: exists already; --force overwrites it\n");
  write("table.csv", "seconds,proud\n0,1\n");
  EXPECT_EQ(stylize("takes/a.bvh --strengths table.csv --dry-run").out,
            "would write takes/a-old-table.bvh from takes/a.bvh\n");
  EXPECT_EQ(run("convert takes/a.bvh --to glb --dry-run").out,
            "would write takes/a.glb from takes/a.bvh\n");
  EXPECT_EQ(run("convert takes/a.bvh").err,
            "panache: --output is required: takes/a.bvh is the input itself\n");
  EXPECT_EQ(run("retarget takes/a.bvh --onto takes/b.bvh --dry-run").out,
            "would write takes/a-on-b.bvh from takes/a.bvh\n");
  const Ran many = stylize("takes");
  EXPECT_EQ(many.exit, 2);
  EXPECT_EQ(many.err, "panache: --output is required: a folder for the results of 5 files\n");
}

TEST_F(Batch, ctrl_c_leaves_whole_files_and_says_how_far_it_came) {
  for (int i = 0; i < 300; ++i) write_walk("many/" + std::to_string(i) + ".bvh", 40);
  const pid_t batch = start("stylize many --style old=1 -o out --jobs 1");
  while (!exists("out")) ::usleep(1000);
  ::kill(batch, SIGINT);
  const Ran ran = finish(batch);
  EXPECT_EQ(ran.exit, 130);
  EXPECT_EQ(ran.err, "");
  int count = -1;
  ASSERT_EQ(std::sscanf(ran.out.c_str(), "stopped: restyled %d of 300 files in ", &count), 1)
      << ran.out;
  EXPECT_EQ(ran.out.ends_with(" s; --skip-existing goes on with the rest\n"), count > 0) << ran.out;
  EXPECT_EQ(entries("out").size(), static_cast<size_t>(count));
  for (const std::string& name : entries("out")) {
    EXPECT_EQ(run({"info", "out/" + name, "--json"}).exit, 0) << name;
  }
}

TEST_F(Batch, nothing_found_is_said) {
  EXPECT_EQ(stylize("takes/*.glb -o out").err,
            "panache: takes/*.glb: no motion file has a name that matches this (.bvh, .glb, .gltf, "
            ".vrm, .vrma, .amc, .fbx, .npz)\n");
  const Ran none = stylize("none/**/*.bvh -o out");
  EXPECT_EQ(none.exit, 1);
  EXPECT_EQ(none.err, "panache: none: cannot be read: No such file or directory\n");
}

}  // namespace
}  // namespace panache::test
