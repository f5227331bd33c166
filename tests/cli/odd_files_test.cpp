// What the verbs do with files that are odd and can be used all the same: animations beside the
// body, rates and counts that are wrong.

#include <array>
#include <nlohmann/json.hpp>

#include "cli/program.h"
#include "clip/make_character.h"

namespace panache::test {
namespace {

class OddFiles : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    GltfParts parts = character();
    Json& all = parts.json["animations"];
    Json blink = {{"name", "blink"}};
    for (const Json& channel : all[1]["channels"]) {
      if (channel["target"]["path"] != "weights") continue;
      blink["samplers"].push_back(all[1]["samplers"][channel["sampler"].get<size_t>()]);
      blink["channels"].push_back({{"sampler", 0}, {"target", channel["target"]}});
    }
    blink_ = blink;
    all.push_back(blink);
    write("hero.glb", to_glb(parts));
    all = Json::array({blink});
    write("blink.glb", to_glb(parts));
    write_walk("walk.bvh");
  }
  Json blink_;
};

constexpr const char* kPassedOver =
    "hero.glb: 'blink' moves no joint of the humanoid and is passed over";

TEST_F(OddFiles, an_animation_of_weights_is_passed_over_and_stays) {
  const std::vector<std::vector<std::string>> verbs = {
      {"stylize", "hero.glb", "--style", "old=1", "--last", "-o", "out.glb", "--force"},
      {"stylize", "hero.glb", "--style", "old=1", "--replace", "-o", "out.glb", "--force"},
      {"retarget", "hero.glb", "--onto", "hero.glb", "--last", "-o", "out.glb", "--force"}};
  for (const auto& verb : verbs) {
    const Ran ran = must(verb);
    EXPECT_TRUE(holds(ran.err, kPassedOver));
    const Json out = glb_parts(read("out.glb")).json["animations"];
    EXPECT_EQ(out[2], blink_);
    EXPECT_EQ(out.size(), std::find(verb.begin(), verb.end(), "--replace") == verb.end() ? 5u : 3u);
  }
  const Ran info = run("info hero.glb --json");
  const Json shown = Json::parse(info.out);
  EXPECT_EQ(shown["clips"][0]["moves"], true);
  EXPECT_EQ(shown["clips"][2]["moves"], false);
  EXPECT_EQ(shown["notes"].size(), 1u);
}

TEST_F(OddFiles, a_file_without_motion_of_the_body_is_rejected) {
  const std::vector<std::vector<std::string>> verbs = {
      {"stylize", "blink.glb", "--style", "old=1", "-o", "out.glb"},
      {"stylize", "hero.glb", "--clip", "blink", "--style", "old=1", "-o", "out.glb"},
      {"retarget", "blink.glb", "--onto", "hero.glb", "-o", "out.glb"},
      {"convert", "blink.glb", "-o", "out.bvh"},
      {"info", "blink.glb"}};
  for (const auto& verb : verbs) {
    const Ran ran = run(verb);
    EXPECT_EQ(ran.exit, 1) << verb[0];
    EXPECT_TRUE(holds(ran.err, "'blink' moves no joint"));
  }
}

TEST_F(OddFiles, a_rate_is_given_and_written) {
  std::string text = read("walk.bvh");
  const size_t at = text.find("Frame Time:");
  text.replace(at, text.find('\n', at) - at, "Frame Time: 0");
  write("zero.bvh", text);
  const Ran wrong = run("convert zero.bvh -o out.bvh");
  EXPECT_EQ(wrong.exit, 1);
  EXPECT_TRUE(holds(wrong.err, "give its rate (--fps N"));
  EXPECT_EQ(run("convert zero.bvh --fps nan -o out.bvh").exit, 2);
  for (const auto& verb : std::vector<std::vector<std::string>>{
           {"convert", "zero.bvh", "--fps", "50", "-o", "out.bvh", "--force"},
           {"stylize", "zero.bvh", "--fps", "50", "--style", "old=1", "-o", "out.bvh",
            "--force"}}) {
    must(verb);
    EXPECT_TRUE(holds(read("out.bvh"), "Frame Time: 0.020000000\n")) << verb[0];
  }
}

// Its text with another frame time.
std::string with_frame_time(std::string text, const std::string& time) {
  const size_t at = text.find("Frame Time:");
  return text.replace(at, text.find('\n', at) - at, "Frame Time: " + time);
}

TEST_F(OddFiles, every_verb_takes_a_rate_and_doubts_one_that_no_walk_has) {
  must("walker -o steady.bvh --seconds 6 --force");
  write("zero.bvh", with_frame_time(read("steady.bvh"), "0"));
  const std::vector<std::vector<std::string>> verbs = {
      {"info"},
      {"convert", "-o", "out.bvh", "--force"},
      {"convert", "-o", "out.glb", "--force"},
      {"stylize", "--style", "old=1", "-o", "out.bvh", "--force"},
      {"retarget", "--onto", "walk.bvh", "-o", "out.bvh", "--force"}};
  for (const auto& [file, fps, found] :
       {std::array{"fast.bvh", "240", "too fast"}, std::array{"slow.bvh", "12", "too slow"}}) {
    write(file, with_frame_time(read("steady.bvh"), std::to_string(1 / std::stod(fps))));
    for (std::vector<std::string> verb : verbs) {
      verb.insert(verb.begin() + 1, file);
      const Ran doubted = run(verb);
      EXPECT_EQ(doubted.exit, 0) << verb[0] << doubted.err;
      EXPECT_TRUE(holds(doubted.err, found)) << verb[0] << doubted.err;
      EXPECT_TRUE(holds(doubted.err, "give its rate (--fps N"));
      verb[1] = "zero.bvh";
      verb.insert(verb.end(), {"--fps", fps});
      EXPECT_TRUE(holds(run(verb).err, found)) << verb[0];
      verb.back() = "60";
      EXPECT_FALSE(holds(run(verb).err, "give its rate")) << verb[0];
    }
  }
}

TEST_F(OddFiles, a_wrong_count_is_noted) {
  std::string text = read("walk.bvh");
  const size_t at = text.find("Frames:");
  text.replace(at, text.find('\n', at) - at, "Frames: 99999");
  write("long.bvh", text);
  const Ran ran = must("stylize long.bvh --style old=1 -o out.bvh --json");
  EXPECT_TRUE(holds(ran.err, "found '99999'"));
  EXPECT_EQ(Json::parse(ran.out)[0]["notes"].size(), 1u);
  EXPECT_FALSE(holds(read("out.bvh"), "99999"));
}

}  // namespace
}  // namespace panache::test
