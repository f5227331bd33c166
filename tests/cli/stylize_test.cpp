// panache stylize: what it makes, and where it puts it.

#include <cmath>
#include <cstdio>
#include <numeric>
#include <sstream>

#include <nlohmann/json.hpp>

#include "clip/clip.h"
#include "clip/motion_format.h"
#include "cli/program.h"

namespace panache::test {
namespace {

using Stylize = ProgramTest;

std::string motion_block(const std::string& bvh) {
  const size_t at = bvh.find("MOTION");
  return at == std::string::npos ? "" : bvh.substr(at);
}

std::string hierarchy(const std::string& bvh) { return bvh.substr(0, bvh.find("MOTION")); }

std::string line_with(const std::string& text, const std::string& word) {
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) {
    if (line.find(word) != std::string::npos) return line;
  }
  return "";
}

// How fast the toes of a file move over the ground in the slowest fifth of their frames, m/s.
double toe_speed(const std::string& path) {
  const auto file = read_motion(path);
  if (!file.ok()) return -1;
  const Clip& clip = (*file)->clip();
  std::vector<Quat> rotations(clip.joints());
  std::vector<Vec3> now(clip.joints()), before(clip.joints());
  std::vector<double> speeds;
  for (int f = 0; f < clip.frames; ++f) {
    std::swap(now, before);
    world_pose(clip.skeleton, clip.pose(f), {rotations, now});
    for (size_t j = 0; f > 0 && j < clip.joints(); ++j) {
      if (clip.skeleton.joints[j].name.find("Toe") == std::string::npos) continue;
      const Vec3 step = now[j] - before[j];
      speeds.push_back(static_cast<double>(std::hypot(step.x, step.z)) / clip.frame_time);
    }
  }
  std::sort(speeds.begin(), speeds.end());
  speeds.resize(speeds.size() / 5);
  return std::accumulate(speeds.begin(), speeds.end(), 0.0) / static_cast<double>(speeds.size());
}

int frames_of(const std::string& bvh) { return std::stoi(line_with(bvh, "Frames:").substr(7)); }

TEST_F(Stylize, changes_the_motion_and_nothing_else) {
  write_walk("walk.bvh");
  const Ran ran = must("stylize walk.bvh --style old=1 -o old.bvh");
  EXPECT_EQ(ran.err, "");
  EXPECT_TRUE(begins(ran.out, "restyled walk.bvh into old.bvh ("));
  const std::string before = read("walk.bvh"), after = read("old.bvh");
  EXPECT_TRUE(hierarchy(after) == hierarchy(before));
  EXPECT_EQ(line_with(after, "Frame Time"), line_with(before, "Frame Time"));
  EXPECT_TRUE(motion_block(after) != motion_block(before));
}

TEST_F(Stylize, keeps_the_number_of_frames_without_timing) {
  write_walk("walk.bvh");
  const Ran timed = run("stylize walk.bvh --style old=3 -o timed.bvh");
  must("stylize walk.bvh --style old=3 --no-timing -o untimed.bvh");
  EXPECT_EQ(frames_of(read("untimed.bvh")), 40);
  EXPECT_NE(frames_of(read("timed.bvh")), 40) << "the model does change the tempo";
}

TEST_F(Stylize, leaves_the_feet_alone_when_asked) {
  must("walker -o walk.bvh --seconds 3");
  TensorFile model = make_model({"old"});
  // Both feet are planted, as this model sees it.
  model.tensors["contact.head.0.bias"] = constant_tensor(kFeet, 5);
  write("model.safetensors", format_safetensors(model));
  must("stylize walk.bvh --style old=1 --no-timing -o locked.bvh");
  must("stylize walk.bvh --style old=1 --no-timing --no-feet -o free.bvh");
  // Feet that are held creep towards this style by two centimetres a second, and those that are not
  // go with it.
  EXPECT_LT(toe_speed(path("walk.bvh")), 0.01);
  EXPECT_LT(toe_speed(path("locked.bvh")), 0.03);
  EXPECT_GT(toe_speed(path("free.bvh")), 0.04);
}

TEST_F(Stylize, changes_strength_along_the_clip) {
  write_walk("walk.bvh");
  const Ran ran =
      must("stylize walk.bvh --style old=0..1 --style sad=2..-1 --no-timing --json -o out.bvh");
  const auto styles = nlohmann::json::parse(ran.out)[0]["clips"][0]["styles"];
  ASSERT_EQ(styles.size(), 2u);
  EXPECT_EQ(styles[0]["name"], "old");
  EXPECT_EQ(styles[0]["points"][0]["seconds"], 0.0);
  EXPECT_EQ(styles[0]["points"][0]["strength"], 0.0);
  // The last of 40 frames. The file has its frame time to nine digits.
  EXPECT_NEAR(styles[0]["points"][1]["seconds"].get<double>(), 39 / 30.0, 39e-9);
  EXPECT_EQ(styles[0]["points"][1]["strength"], 1.0);
  EXPECT_EQ(styles[1]["points"][1]["strength"], -1.0);
}

TEST_F(Stylize, reads_strengths_from_a_table_like_the_command_line) {
  write_walk("walk.bvh");
  write("table.csv", "seconds, old,proud\r\n0,1,0.5\r\n\r\n1.3, 1 ,0.5\r\n");
  must("stylize walk.bvh --strengths table.csv -o a.bvh");
  run("stylize walk.bvh --style old=1 --style proud=.5 -o b.bvh");
  EXPECT_TRUE(read("a.bvh") == read("b.bvh"));
}

TEST_F(Stylize, takes_files_after_a_style_and_leaves_nothing_half_written) {
  write_walk("a.bvh");
  must("stylize -o out/ --style sad=1 a.bvh");
  EXPECT_EQ(entries("out"), std::vector<std::string>{"a.bvh"});
  EXPECT_EQ(entries(), (std::vector<std::string>{"a.bvh", "model.safetensors", "out"}));
}

TEST_F(Stylize, gives_the_same_files_however_many_at_once) {
  for (int i = 0; i < 9; ++i) write_walk("in/" + std::to_string(i) + ".bvh", 10 + i);
  must("stylize in --style proud=1 --jobs 1 -o one/");
  must("stylize in --style proud=1 --jobs 7 -o many/");
  for (const std::string& name : entries("in")) {
    EXPECT_TRUE(read("one/" + name) == read("many/" + name)) << name;
  }
}

TEST_F(Stylize, tells_machines_about_each_file) {
  write_walk("a.bvh");
  write("b.bvh", "");
  const Ran ran = run("stylize a.bvh b.bvh --style old=1 --no-timing --json -o out");
  EXPECT_EQ(ran.exit, 1);
  const auto files = nlohmann::json::parse(ran.out);
  ASSERT_EQ(files.size(), 2u);
  EXPECT_EQ(files[0]["in"], "a.bvh");
  EXPECT_EQ(files[0]["out"], "out/a.bvh");
  EXPECT_EQ(files[0]["ok"], true);
  EXPECT_TRUE(files[0]["error"].is_null());
  ASSERT_EQ(files[0]["clips"].size(), 1u);
  EXPECT_EQ(files[0]["clips"][0]["frames_in"], 40);
  EXPECT_EQ(files[0]["clips"][0]["frames_out"], 40);
  EXPECT_EQ(files[0]["frames"], 40);
  EXPECT_NEAR(files[0]["seconds"].get<double>(), 40 / 30.0, 40e-9);
  EXPECT_EQ(files[0]["mapping"]["joints"].size(), 21u);
  EXPECT_TRUE(files[1]["mapping"].is_null());
  EXPECT_EQ(files[1]["ok"], false);
  EXPECT_EQ("panache: " + files[1]["error"].get<std::string>() + "\n", ran.err);
}

TEST_F(Stylize, tells_how_far_the_styles_know_the_motion_when_asked) {
  write_walk("walk.bvh");
  // The first two lines: that it was restyled, and what was done to it.
  const auto summary = [](const Ran& ran) {
    return ran.out.substr(0, ran.out.find('\n', ran.out.find('\n') + 1) + 1);
  };
  const Words quiet = "stylize walk.bvh --style old=1 --no-timing --force -o old.bvh";
  const Words verbose = quiet + "--verbose", machine = quiet + "--json";
  const Ran silent = run(quiet);
  EXPECT_EQ(silent.out, summary(silent));
  const Ran open = run(verbose);
  EXPECT_EQ(open.out, summary(open) +
                          "  walk.bvh: gate 1.00 (least 1.00; 0 % of frames eased to "
                          "the mean posture)\n");
  // A model whose gate closes and opens within a step.
  TensorFile model = *parse_safetensors(read("model.safetensors"), "model");
  add_gate(model, 1);
  write("model.safetensors", format_safetensors(model));
  const auto gate = nlohmann::json::parse(run(machine).out)[0]["clips"][0]["gate"];
  const double mean = gate["mean"], min = gate["least"], eased = gate["eased"];
  EXPECT_LT(min, 0.5);
  EXPECT_GT(mean, 0.5);
  EXPECT_GT(eased, 0);
  EXPECT_LT(eased, 0.5);
  EXPECT_NEAR(eased * 40, std::round(eased * 40), 1e-9);  // Of 40 frames.
  char line[128];
  std::snprintf(line, sizeof line,
                "  walk.bvh: gate %.2f (least %.2f; %.0f %% of frames eased to the mean posture)\n",
                mean, min, 100 * eased);
  const Ran closed = run(verbose);
  EXPECT_EQ(closed.out, summary(closed) + line);
  EXPECT_EQ(closed.err, "");
}

TEST_F(Stylize, tells_unasked_where_most_of_a_motion_is_unlike_the_training_data) {
  write_walk("walk.bvh");
  TensorFile model = *parse_safetensors(read("model.safetensors"), "model");
  add_gate(model, 1);
  for (float& mean : model.tensors["gate.mean"].values) mean += 100;
  write("model.safetensors", format_safetensors(model));
  const Words arguments = "stylize walk.bvh --style old=1 --json";
  const Ran ran = run(arguments);
  EXPECT_EQ(ran.err,
            "panache: walk.bvh: 100 % of its frames are unlike the motion that the styles were "
            "trained on; those were eased towards the mean posture of the style\n");
  EXPECT_EQ("panache: " + nlohmann::json::parse(ran.out)[0]["notes"][0].get<std::string>() + "\n",
            ran.err);
}

}  // namespace
}  // namespace panache::test
