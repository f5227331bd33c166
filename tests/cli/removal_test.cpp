// Styles taken off the input: --remove, --neutral and --remover; and told: info --styles.

#include <nlohmann/json.hpp>

#include "cli/program.h"
#include "style/model/model.h"

namespace panache::test {
namespace {

class RemovalOptions : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    write_walk("walk.bvh", 90);
    write_remover("remover.safetensors", {"angry", "old", kAnyStyle});
  }
  void write_remover(const std::string& name, const std::vector<std::string>& styles,
                     uint32_t seed = 7, double rate = 0) const {
    TensorFile remover = make_model(styles, seed);
    remover.metadata[kDirection] = kRemove;
    if (rate != 0) set_rate(remover, rate);
    write(name, format_safetensors(remover));
  }
  std::string made(const Words& more) {
    must("stylize walk.bvh --remover remover.safetensors --force -o out.bvh" + more);
    return read("out.bvh");
  }
  std::string rejection(const Words& more, int exit = 2) {
    const Ran ran = run("stylize walk.bvh -o no.bvh" + more);
    EXPECT_EQ(ran.exit, exit);
    EXPECT_FALSE(exists("no.bvh"));
    return ran.err;
  }
};

TEST_F(RemovalOptions, a_style_is_taken_off_before_another_is_put_on) {
  const std::string off = made("--remove old");
  EXPECT_NE(off, read("walk.bvh"));
  EXPECT_NE(off, made("--neutral"));
  const std::string both = made("--remove old --style proud=1");
  write("off.bvh", off);
  must("stylize off.bvh --style proud=1 -o twice.bvh");
  EXPECT_NE(both, off);
  EXPECT_EQ(both.substr(0, both.find("Frame Time")),
            read("twice.bvh").substr(0, read("twice.bvh").find("Frame Time")));
}

TEST_F(RemovalOptions, with_timing_off_the_tempo_of_what_is_taken_off_stays) {
  write_remover("remover.safetensors", {"old", kAnyStyle}, 7, 0.5);
  const auto frames = [&](const std::string& timing) {
    const std::string bvh = made({"--remove", "old", "--timing", timing});
    return std::stoi(bvh.substr(bvh.find("Frames:") + 7));
  };
  EXPECT_EQ(frames("off"), 90);
  EXPECT_GT(frames("all"), 120);
}

TEST_F(RemovalOptions, without_a_style_no_name_is_missing_and_the_result_is_called_neutral) {
  must("stylize walk.bvh --neutral --remover remover.safetensors");
  EXPECT_TRUE(exists("walk-neutral.bvh"));
}

TEST_F(RemovalOptions, the_report_names_what_was_removed) {
  const Ran ran =
      must("stylize walk.bvh --remove OLD --remover remover.safetensors --json -o out.bvh");
  const auto clip = nlohmann::json::parse(ran.out)[0]["clips"][0];
  EXPECT_EQ(clip["removed"], "old");
  EXPECT_TRUE(clip["result"].get<std::string>().ends_with("(old off)")) << clip;
}

TEST_F(RemovalOptions, what_does_not_fit_is_rejected) {
  EXPECT_EQ(rejection("--remove odl --remover remover.safetensors"),
            "panache: --remove: unknown style 'odl'; the nearest is old\n");
  EXPECT_TRUE(holds(rejection("--remove old --neutral"), "--neutral"));
  EXPECT_EQ(rejection("--style old=1 --remover remover.safetensors"),
            "panache: --remover: nothing is to be taken off; add --remove STYLE or --neutral\n");
  EXPECT_EQ(rejection("--remove old --remover model.safetensors", 1),
            "panache: model.safetensors: puts styles on; expected a model that takes them off\n");
}

TEST_F(RemovalOptions, a_batch_with_another_removal_is_not_taken_for_done) {
  const auto batch = [&](const std::string& style) {
    return run({"stylize", "walk.bvh", "--remove", style, "--remover", "remover.safetensors", "-o",
                "out/", "--skip-existing", "--report", "report.jsonl"});
  };
  ASSERT_EQ(batch("old").exit, 0);
  EXPECT_EQ(batch("old").exit, 0);
  const Ran other = batch("angry");
  EXPECT_NE(other.exit, 0);
  EXPECT_TRUE(holds(other.err, "--remove"));
}

TEST_F(RemovalOptions, a_batch_with_another_shipped_remover_is_not_taken_for_done) {
  std::filesystem::create_directory(path("models"));
  std::filesystem::copy(PANACHE_PROGRAM, path("panache"));
  const auto batch = [&](uint32_t seed) {
    write_remover("models/remover-int8.safetensors", {"old", kAnyStyle}, seed);
    return run("stylize walk.bvh --neutral -o out/ --skip-existing --report report.jsonl",
               "model.safetensors", path("panache"));
  };
  ASSERT_EQ(batch(7).exit, 0);
  EXPECT_EQ(batch(7).exit, 0);
  const Ran other = batch(8);
  EXPECT_NE(other.exit, 0);
  EXPECT_TRUE(holds(other.err, "--remover"));
}

TEST_F(RemovalOptions, info_tells_the_styles_of_a_motion) {
  const Ran ran = must("info walk.bvh --styles --json");
  const auto styles = nlohmann::json::parse(ran.out)["styles"];
  ASSERT_FALSE(styles.empty());
  double sum = 0;
  for (const auto& style : styles) sum += style["share"].get<double>();
  EXPECT_GT(sum, 0.6);
  EXPECT_LE(sum, 1.001);
  EXPECT_TRUE(holds(run("info walk.bvh --styles").out, "  styles  "));
  EXPECT_FALSE(holds(run("info walk.bvh").out, "  styles  "));
}

}  // namespace
}  // namespace panache::test
