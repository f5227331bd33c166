// panache-lab train, where it cannot go on.
#include <csignal>
#include <filesystem>

#include <nlohmann/json.hpp>

#include "lab_program.h"
#include "make_manifest.h"

namespace panache {
namespace {

using test::begins;
using test::holds;
using test::Words;

class Train : public test::LabTest {
 protected:
  void SetUp() override {
    LabTest::SetUp();
    test::write_manifest(path(""));
  }
};

TEST_F(Train, a_checkpoint_that_cannot_be_saved_ends_it_with_one_message) {
  // Where a checkpoint is to be written there is a link into a folder that does not exist.
  std::filesystem::create_symlink("none/x", path("mine.safetensors.pose.checkpoint"));
  const test::Ran ran = run("train manifest.csv --steps 5 -o mine.safetensors");
  EXPECT_EQ(ran.exit, 1);
  EXPECT_TRUE(holds(ran.err, "panache-lab: mine.safetensors.pose.checkpoint: cannot be written"));
  const std::string last = ran.err.substr(ran.err.find("panache-lab: "));
  EXPECT_EQ(std::count(last.begin(), last.end(), '\n'), 1) << ran.err;
  EXPECT_FALSE(exists("mine.safetensors"));
}

TEST_F(Train, motion_without_styles_is_only_for_recipes_that_can_use_it) {
  const Words command = "train manifest.csv --unlabelled pool.csv --steps 5 -o mine.safetensors";
  test::Ran ran = run(command);
  EXPECT_EQ(ran.exit, 1);
  EXPECT_TRUE(holds(ran.err, "pool.csv"));
  write("pool.csv", "path,style,content,take,neutral,split\nneutral.bvh,any,walk,001,1,train\n");
  ran = run(command + "--recipe smith2019");
  EXPECT_EQ(ran.exit, 1);
  EXPECT_EQ(ran.err,
            "panache-lab: --unlabelled: recipe smith2019 learns from styled takes alone; leave the "
            "option out\n");
  EXPECT_FALSE(exists("mine.safetensors"));
}

TEST_F(Train, a_style_that_cannot_be_learnt_is_an_error_and_whatever_is_left_out_is_told) {
  const std::string rows = read("manifest.csv");
  write("manifest.csv", rows + "old.bvh,sad,crawl,001,0,train\nold.bvh,old,crawl,001,0,train\n");
  const Words all = "train manifest.csv --steps 5 -o m.safetensors",
              command = all + "--styles styles.csv";
  test::Ran ran = run(all);
  EXPECT_EQ(ran.exit, 1);
  EXPECT_EQ(
      ran.err,
      "panache-lab: nothing can be learnt of 1 style: 'sad' (crawl); expected a neutral take of "
      "one of these contents, to train on, in the manifest of the style; add one, or leave "
      "the style out (--styles lists those to learn)\n");
  EXPECT_FALSE(exists("m.safetensors"));
  write("styles.csv", "name,from,description\nold,old,\n");
  ran = run(command);
  EXPECT_EQ(ran.exit, 0) << ran.err;
  EXPECT_TRUE(begins(
      ran.err,
      "panache-lab: manifest.csv: style 'sad' is left out: it is not among the styles to learn (1 "
      "take)\n"
      "panache-lab: manifest.csv: content 'crawl' is left out: it has no neutral take (1 take of "
      "old)\n"));
  EXPECT_TRUE(holds(ran.out, "\nstyle     takes  seconds  samples\nold           1      "));
  // Nothing is held back of two takes.
  const std::string losses = read("m.safetensors.losses.csv");
  EXPECT_TRUE(holds(losses, "pose,5,"));
  EXPECT_FALSE(holds(losses, "0.000000"));
  EXPECT_TRUE(holds(losses, ",\n"));
  const auto report = nlohmann::json::parse(run(command + "--json --force").out);
  EXPECT_EQ(report["left_out"].size(), 2u);
  EXPECT_EQ(report["styles"].size(), 1u);
  EXPECT_EQ(report["styles"][0]["name"], "old");
  EXPECT_EQ(report["styles"][0]["takes"], 1);
  EXPECT_EQ(report["styles"][0]["samples"], report["samples"]);
}

TEST_F(Train, all_missing_files_are_named_at_once) {
  write("manifest.csv", read("manifest.csv") +
                            "a.bvh,old,walk,002,0,train\nb/c.bvh,old,walk,003,0,train\n"
                            "d.bvh,old,walk,004,0,test\n");
  const test::Ran ran = run("train manifest.csv --steps 5 -o m.safetensors");
  EXPECT_EQ(ran.exit, 1);
  EXPECT_EQ(
      ran.err,
      "panache-lab: manifest.csv:4: a.bvh: there is no such file\n"
      "panache-lab: manifest.csv:5: b/c.bvh: there is no such file\n"
      "panache-lab: 2 of 4 takes are missing; expected paths that start at the folder of their "
      "manifest\n");
}

TEST_F(Train, ctrl_c_says_what_is_left_and_the_same_command_goes_on) {
  const Words command = "train manifest.csv --steps 100 -o m.safetensors";
  const pid_t training = start(command);
  const auto is_over = [&] {
    siginfo_t info{};
    constexpr int kLook = WEXITED | WNOHANG | WNOWAIT;
    return ::waitid(P_PID, static_cast<id_t>(training), &info, kLook) != 0 || info.si_pid != 0;
  };
  while (!exists("m.safetensors.pose.checkpoint") && !is_over()) ::usleep(1000);
  ::kill(training, SIGINT);
  test::Ran ran = finish(training);
  ASSERT_EQ(ran.exit, 130) << ran.err;
  EXPECT_TRUE(
      begins(ran.err, "panache-lab: stopped; the same command goes on from the last checkpoint"));
  EXPECT_TRUE(holds(ran.err, "m.safetensors.pose.checkpoint"));
  EXPECT_FALSE(exists("m.safetensors"));
  ran = run(command);
  EXPECT_EQ(ran.exit, 0) << ran.err;
  EXPECT_FALSE(exists("m.safetensors.pose.checkpoint"));
}

TEST_F(Train, manifests_may_name_files_that_only_the_program_reads) {
  const test::Ran converted = run_panache("convert neutral.bvh -o neutral.npz");
  if (converted.exit != 0) GTEST_SKIP() << "this build has no libzip";
  write("pool.csv", "path,style,content,take,neutral,split\nneutral.npz,any,walk,001,1,train\n");
  const test::Ran ran =
      run("train manifest.csv --unlabelled pool.csv --steps 5 -o mine.safetensors");
  EXPECT_EQ(ran.exit, 0) << ran.err;
  EXPECT_TRUE(exists("mine.safetensors"));
}

TEST_F(Train, motion_in_styles_is_needed) {
  write("pool.csv", "path,style,content,take,neutral,split\nneutral.bvh,any,walk,001,1,train\n");
  for (const char* arguments :
       {"train -o mine.safetensors", "train --unlabelled pool.csv -o mine.safetensors"}) {
    const test::Ran ran = run(arguments);
    EXPECT_EQ(ran.exit, 2);
    EXPECT_EQ(ran.err, "panache-lab: manifests is required; see panache-lab train --help\n");
  }
}

}  // namespace
}  // namespace panache
