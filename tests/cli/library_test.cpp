// Gestures and styles that are shared: learnt with a source and a licence, taken out, listed.

#include <cmath>
#include <filesystem>

#include <nlohmann/json.hpp>

#include "cli/program.h"
#include "make_model.h"
#include "rig/rig.h"

namespace panache::test {
namespace {

using enum HumanJoint;

// A glance to the left, as a tensor.
Tensor glance() {
  std::vector<GesturePose> points(15);
  for (size_t k = 0; k < points.size(); ++k) {
    points[k].turns[index(head)].y = 0.8f * std::sin(3.14159f * static_cast<float>(k + 1) / 16);
  }
  return Gesture(points).tensor();
}

class StyleLibraryTest : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    TensorFile model = *parse_safetensors(read("model.safetensors"), "model");
    add_learnt(model, 0, "limping", "limp.bvh");
    model.tensors["learnt.0.gesture.0"] = glance();
    model.tensors["gesture.1.0"] = glance();  // Of 'old'.
    model.metadata["style_gesture_rates"] = "\n0.5\n\n\n\n";
    model.metadata["style_sources"] = "\n\n\n\nmy own capture\n";
    model.metadata["style_licences"] = "\n\n\n\nCC0\n";
    write("mine.safetensors", format_safetensors(model));
  }
};

TEST_F(StyleLibraryTest, styles_are_listed_with_their_gestures) {
  const std::string text = run("styles mine.safetensors").out;
  EXPECT_TRUE(holds(
      text, "  old      looks old\n           gestures, 0.5 a second: glances left, 1.2 s\n"));
  const auto printed = nlohmann::json::parse(run("styles mine.safetensors --json").out);
  EXPECT_EQ(printed["styles"][1]["gestures"], nlohmann::json({"glances left, 1.2 s"}));
  EXPECT_EQ(printed["styles"][1]["gesture_rate"], "0.5");
  EXPECT_TRUE(printed["styles"][0]["gestures"].empty());
  EXPECT_EQ(printed["styles"][4]["source"], "my own capture");
  EXPECT_EQ(printed["styles"][4]["licence"], "CC0");
}

TEST_F(StyleLibraryTest, a_folder_of_style_files_is_a_library) {
  std::filesystem::create_directory(path("library"));
  for (const char* name : {"limping", "old"}) {
    must({"styles", "mine.safetensors", "--extract", name, "-o",
          "library/" + std::string(name) + ".safetensors"});
  }
  write("library/model.safetensors", read("mine.safetensors"));  // No style.
  write("library/notes.txt", "no style");
  const Ran listed = must("styles library");
  EXPECT_EQ(listed.out,
            "library\n2 styles:\n"
            "  limping  looks limping\n"
            "           source: my own capture; licence: CC0; limping.safetensors\n"
            "  old      looks old\n"
            "           source: not stated; licence: CC0; old.safetensors\n");
  const auto printed = nlohmann::json::parse(run("styles library --json").out);
  ASSERT_EQ(printed["styles"].size(), 2u);
  for (const auto& style : printed["styles"]) {
    const std::string picture = style["thumbnail"];
    EXPECT_TRUE(picture.starts_with("<svg ") && picture.ends_with("</svg>")) << picture;
    EXPECT_LE(picture.size(), 12'000u);
    EXPECT_EQ(style["gestures"], nlohmann::json({"glances left, 1.2 s"}));
  }
  EXPECT_EQ(printed["styles"][0]["style_licence"], "CC0");
  // What is not readable is told, and the others are listed.
  write("library/broken.safetensors", "broken");
  const Ran broken = run("styles library");
  EXPECT_EQ(broken.exit, 1);
  EXPECT_EQ(broken.out, listed.out);
  EXPECT_TRUE(holds(broken.err, "library/broken.safetensors: "));
  EXPECT_EQ(run("styles nowhere/").exit, 1);
}

TEST_F(StyleLibraryTest, a_style_keeps_all_that_is_said_of_it_on_its_way) {
  const auto extract = [&](const std::string& from, const std::string& to) {
    must({"styles", from, "--extract", "limping", "-o", to});
    return *parse_safetensors(read(to), to);
  };
  const TensorFile once = extract("mine.safetensors", "once.safetensors");
  EXPECT_EQ(once.metadata.at("source"), "my own capture");
  EXPECT_EQ(once.metadata.at("style_licence"), "CC0");
  write("other.safetensors", read("mine.safetensors"));
  must("styles other.safetensors --remove limping");
  must("styles other.safetensors --add once.safetensors");
  const TensorFile twice = extract("other.safetensors", "twice.safetensors");
  EXPECT_EQ(twice.metadata, once.metadata);
  EXPECT_TRUE(twice.tensors.contains("gesture.0"));
}

TEST_F(StyleLibraryTest, gestures_are_played_as_often_as_asked_for) {
  write_walk("walk.bvh", 240);
  const auto stylize = [&](const std::string& out, Words more) {
    std::vector<std::string> arguments = {"stylize", "walk.bvh", "--model", "mine.safetensors",
                                          "--style", "old=1",    "-o",      out};
    arguments.insert(arguments.end(), more.begin(), more.end());
    if (std::ranges::find(more, "--loop") == more.end()) {
      arguments.insert(arguments.end(), {"--loop", "off"});
    }
    must(arguments);
    return read(out);
  };
  const std::string some = stylize("some.bvh", {});
  EXPECT_EQ(stylize("same.bvh", {"--gestures", "1"}), some);
  const std::string none = stylize("none.bvh", {"--gestures", "0"});
  EXPECT_NE(some, none);
  EXPECT_NE(stylize("more.bvh", {"--gestures", "4"}), some);
  // A loop has none.
  EXPECT_EQ(stylize("loop.bvh", {"--loop", "auto"}),
            stylize("0.bvh", {"--loop", "auto", "--gestures", "0"}));
  for (const char* rate : {"-1", "11", "often"}) {
    EXPECT_EQ(run({"stylize", "walk.bvh", "--style", "old=1", "--gestures", rate}).exit, 2);
  }
}

TEST_F(StyleLibraryTest, learning_tells_of_gestures_and_keeps_source_and_licence) {
  must("walker -o neutral.bvh --seconds 8 --fps 30");
  Clip clip = (*parse_bvh(read("neutral.bvh"), "neutral.bvh"))->clip();
  const Rig rig = *Rig::create(clip);
  for (int f = 90; f <= 135; ++f) {
    const float turn = 0.9f * std::sin(3.14159f * static_cast<float>(f - 90) / 45);
    Quat& rotation = clip.pose(f).rotations[static_cast<size_t>(rig.joints()[index(head)])];
    rotation = rotation * rotation_y(-0.7f * turn);
  }
  write("nosy.bvh", format_bvh(clip));
  const Ran ran = must({"learn", "neutral.bvh", "nosy.bvh", "--name", "nosy", "--into",
                        "new.safetensors", "--source", "my\nown", "--licence", "CC BY 4.0"},
                       "");
  EXPECT_TRUE(holds(ran.out, "  gesture in nosy.bvh at "));
  EXPECT_TRUE(holds(ran.out, " s: glances right, "));
  const auto styles = nlohmann::json::parse(run("styles new.safetensors --json").out)["styles"];
  EXPECT_EQ(styles.back()["gestures"].size(), 1u);
  EXPECT_EQ(styles.back()["source"], "my own");
  EXPECT_EQ(styles.back()["licence"], "CC BY 4.0");
}

}  // namespace
}  // namespace panache::test
