// panache info of motion files: the rig as it was understood, and what the user says of it.

#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "cli/program.h"

namespace panache::test {
namespace {

class Info : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    write_walk("walk.bvh");
  }
  nlohmann::json json_of(Words arguments) {
    arguments.insert(arguments.begin(), "info");
    arguments.emplace_back("--json");
    return nlohmann::json::parse(run(arguments).out);
  }
  // Which joint of walk.bvh the human joint is, as the map in map.json has it.
  nlohmann::json joint(const std::string& human_joint) {
    const nlohmann::json info = json_of("walk.bvh --map map.json");
    for (const auto& entry : info["mapping"]["joints"]) {
      if (entry["humanoid"] == human_joint) return entry["joint"];
    }
    return "no such joint";
  }
};

TEST_F(Info, shows_how_the_rig_was_mapped) {
  const Ran ran = must("info walk.bvh --tree");
  EXPECT_TRUE(holds(ran.out, "  joints  21, of which 21 rotate and 1 move\n"));
  EXPECT_TRUE(holds(ran.out, "  motion  40 frames at 30 a second: 1.33 s\n"));
  EXPECT_TRUE(holds(ran.out, "  unit    1 m (metres, most likely), inferred from the legs\n"));
  EXPECT_TRUE(holds(ran.out, "  up      +Y\n"));
  EXPECT_TRUE(holds(ran.out, "  humanoid       joint of the file  sure  how it was found\n"));
  EXPECT_TRUE(holds(ran.out, "  leftHand       leftHand           100%  by its name\n"));
  EXPECT_TRUE(holds(ran.out, "\n  hips (moves)\n    spine\n      chest\n"));
}

TEST_F(Info, draws_the_motion_as_figures) {
  run("walker --seconds 2.5 -o long.bvh");
  const std::string plain = run("info long.bvh").out;
  const Ran ran = run("info long.bvh --figures");
  ASSERT_TRUE(begins(ran.out, plain));
  std::istringstream drawn(ran.out.substr(plain.size()));
  std::vector<std::string> rows;
  for (std::string row; std::getline(drawn, row);) rows.push_back(row);
  // An empty line, nine rows of a body of 1.7 m, the times.
  ASSERT_EQ(rows.size(), 11u) << ran.out;
  EXPECT_EQ(rows.front(), "");
  EXPECT_EQ(rows.back(), "   0.0 s       0.5 s       1.0 s       1.5 s       2.0 s       2.5 s");
  // Characters that are drawn: six skulls of two to four, and below them, six pairs of feet.
  const auto filled = [](const std::string& row) {
    return std::count(row.begin(), row.end(), '\xe2');
  };
  EXPECT_GE(filled(rows[1]), 12) << ran.out;
  EXPECT_LE(filled(rows[1]), 24) << ran.out;
  EXPECT_GE(filled(rows[9]), 12) << ran.out;
}

TEST_F(Info, tells_machines_the_same) {
  const auto info = json_of("walk.bvh");
  ASSERT_EQ(info["clips"].size(), 1u);
  EXPECT_EQ(info["clips"][0]["name"], "");
  EXPECT_EQ(info["clips"][0]["frames"], 40);
  EXPECT_EQ(info["skeleton"].size(), 21u);
  ASSERT_EQ(info["mapping"]["joints"].size(), 21u);
  EXPECT_EQ(info["mapping"]["joints"][8]["humanoid"], "leftHand");
  EXPECT_EQ(info["mapping"]["joints"][8]["joint"], "leftHand");
  EXPECT_EQ(info["mapping"]["joints"][8]["confidence"], 1.0);
  EXPECT_EQ(info["mapping"]["likely_unit"], "metres");
}

TEST_F(Info, shows_a_file_that_is_no_humanoid_too) {
  Skeleton box;
  box.joints.push_back({"Box", -1, {}, {}, true, true, {{0, 1, 0}}, ""});
  write("box.bvh", format_bvh({box, 1.0 / 30, 2, std::vector<Quat>(2), std::vector<Vec3>(2)}));
  const Ran ran = run("info box.bvh --tree");
  EXPECT_EQ(ran.exit, 1);
  EXPECT_TRUE(holds(ran.out, "  joints  1, of which 1 rotate and 1 move\n"));
  EXPECT_TRUE(holds(ran.out, "\nSkeleton:\n  Box (moves)\n"));
  EXPECT_TRUE(begins(ran.err, "panache: box.bvh: no humanoid found"));
  const auto info = json_of("box.bvh");
  EXPECT_TRUE(info["mapping"].is_null());
  EXPECT_EQ("panache: " + info["error"].get<std::string>() + "\n", ran.err);
}

TEST_F(Info, believes_a_unit_and_an_axis) {
  const Ran ran = must("info walk.bvh --scale 0.0254 --up z");
  EXPECT_TRUE(holds(ran.out, "  unit    0.0254 m, as given\n  up      +Z, as given\n"));
  for (const std::string axis : {"-x", "-X"}) {
    EXPECT_EQ(json_of({"walk.bvh", "--up", axis})["mapping"]["up_axis"], "-X");
  }
}

TEST_F(Info, rejects_what_is_no_unit_or_axis) {
  for (const std::string axis : {"up", "w", "-", "++y", "+"}) {
    expect_rejected({"info", "walk.bvh", "--up", axis}, 2,
                    "--up: expected an axis (x, y, z, -x, -y or -z), found '" + axis + "'");
  }
  for (const std::string scale : {"0", "nan"}) {
    expect_rejected({"info", "walk.bvh", "--scale", scale}, 2,
                    "--scale: expected a number from 1e-09 to 1000, found " + scale);
  }
}

TEST_F(Info, believes_a_map_and_finds_the_rest) {
  std::string walk = read("walk.bvh");
  walk.replace(walk.find("leftHand"), 8, "Paw");
  write("walk.bvh", walk);
  write("map.json", R"({"leftHand": "Paw", "neck": null})");
  EXPECT_EQ(joint("leftHand"), "Paw");
  EXPECT_TRUE(joint("neck").is_null());
  EXPECT_EQ(joint("rightHand"), "rightHand");
}

TEST_F(Info, takes_back_what_it_printed) {
  nlohmann::json info = json_of("walk.bvh");
  for (auto& entry : info["mapping"]["joints"]) {
    if (entry["humanoid"] == "leftToes") entry["joint"] = nullptr;
  }
  write("map.json", info.dump());
  EXPECT_TRUE(joint("leftToes").is_null());
  EXPECT_EQ(joint("rightToes"), "rightToes");
}

TEST_F(Info, rejects_a_map_that_is_none) {
  const std::string example = "expected JSON such as {\"leftHand\": \"Hand_L\", \"neck\": null}";
  const std::pair<const char*, std::string> cases[] = {
      {"{\n  \"leftHand\" \"x\"\n}", ":2:16: " + example},
      {"", ":1:1: " + example},
      {"[]", ": " + example + ", found a JSON array"},
      {"{}", ": " + example + ", found nothing in it"},
      {R"({"leftHnad": "x"})",
       ": unknown human joint 'leftHnad'; the nearest is leftHand (panache info lists all 21)"},
      {R"({"leftHand": 3})", ": leftHand: expected the name of a joint or null, found 3"},
      {R"({"leftHand": 1e999})", ": " + example + ", found a number that is too large"},
      {R"({"mapping": null})", ": holds no mapping, because that file has no humanoid; " + example},
      {R"({"mapping": {"joints": [{"humanoid": "neck"}]}})",
       ": mapping.joints[0]: expected an object with 'humanoid' and 'joint', as panache info "
       "--json prints them"},
  };
  for (const auto& [map, message] : cases) {
    write("map.json", map);
    expect_rejected("info walk.bvh --map map.json", 1, "map.json" + message);
  }
  expect_rejected("info walk.bvh --map none.json", 1,
                  "none.json: cannot be read: No such file or directory");
}

TEST_F(Info, tells_of_several_files_and_folders_and_goes_on_after_a_bad_one) {
  write_walk("takes/b.bvh");
  write("takes/a.bvh", "HIERARCHY");
  const Ran ran = run("info takes walk.bvh model.safetensors");
  EXPECT_EQ(ran.exit, 1);
  EXPECT_TRUE(begins(ran.err, "panache: takes/a.bvh:"));
  EXPECT_EQ(ran.out, run("info takes/b.bvh").out + "\n" + run("info walk.bvh").out + "\n" +
                         run("info model.safetensors").out);
  const nlohmann::json list = json_of("takes walk.bvh model.safetensors");
  ASSERT_EQ(list.size(), 4u);
  EXPECT_EQ(list[0]["file"], "takes/a.bvh");
  EXPECT_TRUE(holds(list[0]["error"], "takes/a.bvh:"));
  EXPECT_EQ(list[1], json_of("takes/b.bvh"));
  EXPECT_EQ(list[3]["metadata"]["format_version"], "1");
  EXPECT_TRUE(json_of("takes/b.bvh").is_object());
  EXPECT_EQ(json_of("takes/*.bvh").size(), 2u);
}

TEST_F(Info, rejects_a_map_to_a_joint_that_there_is_not) {
  write("map.json", R"({"leftHand": "Hand_L"})");
  const Ran ran = run("info walk.bvh --map map.json");
  EXPECT_EQ(ran.exit, 1);
  EXPECT_TRUE(begins(ran.err, "panache: walk.bvh: "));
  EXPECT_TRUE(holds(ran.err, "'Hand_L'"));
}

}  // namespace
}  // namespace panache::test
