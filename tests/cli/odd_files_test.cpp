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

// The text of a BVH with another value behind `key`.
std::string with(std::string text, const std::string& key, const std::string& value) {
  const size_t at = text.find(key);
  return text.replace(at, text.find('\n', at) - at, key + " " + value);
}

constexpr const char* kPassedOver =
    "hero.glb: 'blink' moves no joint of the humanoid and is passed over";

TEST_F(OddFiles, an_animation_of_weights_is_passed_over_and_stays) {
  const std::pair<const char*, size_t> verbs[] = {
      {"stylize hero.glb --style old=1 --last -o out.glb --force", 5},
      {"stylize hero.glb --style old=1 --replace -o out.glb --force", 3},
      {"retarget hero.glb --onto hero.glb --last -o out.glb --force", 5}};
  for (const auto& [verb, count] : verbs) {
    const Ran ran = must(verb);
    EXPECT_TRUE(holds(ran.err, kPassedOver));
    const Json out = glb_parts(read("out.glb")).json["animations"];
    EXPECT_EQ(out[2], blink_);
    EXPECT_EQ(out.size(), count);
  }
  const Ran info = run("info hero.glb --json");
  const Json shown = Json::parse(info.out);
  EXPECT_EQ(shown["clips"][0]["moves"], true);
  EXPECT_EQ(shown["clips"][2]["moves"], false);
  EXPECT_EQ(shown["notes"].size(), 1u);
}

TEST_F(OddFiles, a_file_without_motion_of_the_body_is_rejected) {
  for (const char* verb : {"stylize blink.glb --style old=1 -o out.glb",
                           "stylize hero.glb --clip blink --style old=1 -o out.glb",
                           "retarget blink.glb --onto hero.glb -o out.glb",
                           "convert blink.glb -o out.bvh", "info blink.glb"}) {
    const Ran ran = run(verb);
    EXPECT_EQ(ran.exit, 1) << verb;
    EXPECT_TRUE(holds(ran.err, "'blink' moves no joint"));
  }
}

TEST_F(OddFiles, a_rate_is_given_and_written) {
  write("zero.bvh", with(read("walk.bvh"), "Frame Time:", "0"));
  const Ran wrong = run("convert zero.bvh -o out.bvh");
  EXPECT_EQ(wrong.exit, 1);
  EXPECT_TRUE(holds(wrong.err, "give its rate (--fps N"));
  EXPECT_EQ(run("convert zero.bvh --fps nan -o out.bvh").exit, 2);
  for (const char* verb : {"convert zero.bvh --fps 50 -o out.bvh --force",
                           "stylize zero.bvh --fps 50 --style old=1 -o out.bvh --force"}) {
    must(verb);
    EXPECT_TRUE(holds(read("out.bvh"), "Frame Time: 0.020000000\n")) << verb;
  }
}

TEST_F(OddFiles, every_verb_takes_a_rate_and_doubts_one_that_no_walk_has) {
  must("walker -o steady.bvh --seconds 6 --force");
  const std::string steady = read("steady.bvh");
  write("zero.bvh", with(steady, "Frame Time:", "0"));
  const Words verbs[] = {"info", "convert -o out.bvh --force", "convert -o out.glb --force",
                         "stylize --style old=1 -o out.bvh --force",
                         "retarget --onto walk.bvh -o out.bvh --force"};
  for (const auto& [file, fps, found] :
       {std::array{"fast.bvh", "240", "too fast"}, std::array{"slow.bvh", "12", "too slow"}}) {
    write(file, with(steady, "Frame Time:", std::to_string(1 / std::stod(fps))));
    for (Words verb : verbs) {
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
  write("long.bvh", with(read("walk.bvh"), "Frames:", "99999"));
  const Ran ran = must("stylize long.bvh --style old=1 -o out.bvh --json");
  EXPECT_TRUE(holds(ran.err, "found '99999'"));
  EXPECT_EQ(Json::parse(ran.out)[0]["notes"].size(), 1u);
  EXPECT_FALSE(holds(read("out.bvh"), "99999"));
}

}  // namespace
}  // namespace panache::test
