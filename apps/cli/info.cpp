// panache info: what a file is, and how its rig was understood.

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "clip/motion_file.h"
#include "model_report.h"
#include "report.h"
#include "rig/rig.h"
#include "verbs.h"

namespace panache::cli {
namespace {

// What the file's unit may be, judged by the length of the legs; empty where nothing comes close.
std::string likely_unit(double metres) {
  struct Unit {
    const char* name;
    double metres;
  };
  static constexpr std::array<Unit, 6> kUnits = {{{"metres", 1},
                                                  {"feet", 0.3048},
                                                  {"CMU units", 0.0564},
                                                  {"inches", 0.0254},
                                                  {"centimetres", 0.01},
                                                  {"millimetres", 0.001}}};
  // The scale is that of canonical legs, and people differ: 1.35 lies half-way between the
  // neighbours in this list that are nearest to each other.
  for (const Unit& unit : kUnits) {
    if (std::abs(std::log(metres / unit.metres)) < std::log(1.35)) return unit.name;
  }
  return "";
}

// Each joint on a line, below and to the right of its parent.
std::string draw_tree(const Skeleton& skeleton) {
  std::vector<std::vector<size_t>> children(skeleton.joints.size());
  std::vector<std::pair<size_t, size_t>> waiting;  // Joint and depth.
  for (size_t j = skeleton.joints.size(); j-- > 0;) {
    const int parent = skeleton.joints[j].parent;
    if (parent < 0) {
      waiting.emplace_back(j, 1);
    } else {
      children[static_cast<size_t>(parent)].push_back(j);
    }
  }
  std::string text;
  while (!waiting.empty()) {
    const auto [j, depth] = waiting.back();
    waiting.pop_back();
    const Joint& joint = skeleton.joints[j];
    text += std::string(2 * depth, ' ') + joint.name;
    text += !joint.can_rotate && !joint.can_translate ? " (fixed)" : "";
    text += joint.can_translate ? (joint.can_rotate ? " (moves)" : " (only moves)") : "";
    text += "\n";
    for (const size_t child : children[j]) waiting.emplace_back(child, depth + 1);
  }
  return text;
}

std::string describe_mapping(const Rig& rig) {
  const std::vector<JointMatch> matches = rig.matches();
  const std::string column = "joint of the file";
  size_t human = 0, own = column.size();
  for (const JointMatch& match : matches) {
    human = std::max(human, match.human_joint.size());
    own = std::max(own, match.joint.size());
  }
  const auto scale = static_cast<double>(rig.scale());
  const std::string unit = likely_unit(scale);
  std::string text = "  unit    " + brief(scale, 3) + " m" +
                     (unit.empty() ? "" : " (" + unit + ", most likely)") +
                     ", judged by the legs\n";
  text += "  up      " + rig.up_axis() + "\n";
  text += std::string("  start   ") +
          (rig.first_frame() ? "the first frame is a calibration pose, not motion: stylize leaves "
                               "it as it is"
                             : "the first frame is motion") +
          "\n";
  text += "\n  " + padded("humanoid", human + 2) + padded(column, own + 2) + "how it was found\n";
  for (const JointMatch& match : matches) {
    text += "  " + padded(match.human_joint, human + 2) +
            padded(match.joint.empty() ? "-" : match.joint, own + 2) + match.reason + "\n";
  }
  if (!rig.notes().empty()) text += "\nNotes:\n";
  for (const std::string& note : rig.notes()) text += "  " + note + "\n";
  return text;
}

std::string describe(const std::string& path, const Clip& clip) {
  const std::vector<Joint>& joints = clip.skeleton.joints;
  const auto rotating = std::count_if(joints.begin(), joints.end(),
                                      [](const Joint& joint) { return joint.can_rotate; });
  const auto moving = std::count_if(joints.begin(), joints.end(),
                                    [](const Joint& joint) { return joint.can_translate; });
  std::string text = path + "\n";
  text += "  joints  " + std::to_string(joints.size()) + ", of which " + std::to_string(rotating) +
          " rotate and " + std::to_string(moving) + " move\n";
  text += "  frames  " + std::to_string(clip.frames) + " at " + brief(1 / clip.frame_time) +
          " a second: " + fixed(clip.duration(), 2) + " s\n";
  return text;
}

Json mapping_json(const Rig& rig) {
  Json joints = Json::array();
  for (const JointMatch& match : rig.matches()) {
    joints.push_back({{"humanoid", match.human_joint},
                      {"joint", match.joint.empty() ? Json() : Json(match.joint)},
                      {"reason", match.reason}});
  }
  const auto scale = static_cast<double>(rig.scale());
  const std::string unit = likely_unit(scale);
  return {{"metres_per_unit", scale}, {"likely_unit", unit.empty() ? Json() : Json(unit)},
          {"up_axis", rig.up_axis()}, {"first_frame", rig.first_frame()},
          {"joints", joints},         {"notes", rig.notes()}};
}

Json skeleton_json(const Skeleton& skeleton) {
  Json joints = Json::array();
  for (const Joint& joint : skeleton.joints) {
    joints.push_back({{"name", joint.name},
                      {"parent", joint.parent},
                      {"offset", {joint.offset.x, joint.offset.y, joint.offset.z}},
                      {"rotates", joint.can_rotate},
                      {"moves", joint.can_translate}});
  }
  return joints;
}

int motion_info(const std::string& path, bool tree, bool json) {
  Result<std::unique_ptr<MotionFile>> file = read_motion(path);
  if (!file) return refuse(file.error(), kBadInput);
  const Clip& clip = (*file)->clip();
  // A file that is no humanoid is still a file that one may want to look at.
  const Result<Rig> rig = Rig::create(clip);
  if (json) {
    print(Json{{"file", path},
               {"frames", clip.frames},
               {"frame_time", clip.frame_time},
               {"seconds", clip.duration()},
               {"skeleton", skeleton_json(clip.skeleton)},
               {"mapping", rig ? mapping_json(*rig) : Json()},
               {"error", rig ? Json() : Json(rig.error().message)}});
  } else {
    print(describe(path, clip));
    if (rig) print(describe_mapping(*rig));
    if (tree) print("\nSkeleton:\n" + draw_tree(clip.skeleton));
  }
  return rig ? kDone : refuse({path + ": " + rig.error().message}, kBadInput);
}

// As styles, and all else that the file says of itself.
int model_info(const std::string& path, bool json) {
  Result<LoadedModel> loaded = load_model(path);
  if (!loaded) return refuse(loaded.error(), kBadInput);
  const auto& metadata = loaded->model->metadata();
  if (json) {
    Json out = to_json(*loaded);
    out["metadata"] = metadata;
    print(out);
    return kDone;
  }
  std::string text = describe(*loaded) + "\nMetadata:\n";
  for (const auto& [key, value] : metadata) {
    // These stand above.
    if (key == "styles" || key == "style_descriptions") continue;
    text += "  " + padded(key, 16) + value + "\n";
  }
  print(text);
  return kDone;
}

}  // namespace

void add_info(CLI::App& app, int& exit_code) {
  CLI::App* verb = app.add_subcommand("info",
                                      "Show a motion file, how its rig was mapped, or a "
                                      "model");
  struct Options {
    std::string file;
    bool tree = false;
    bool json = false;
  };
  auto options = std::make_shared<Options>();
  verb->add_option("FILE", options->file, "Motion file (.bvh) or model (.safetensors)")
      ->required()
      ->type_name("");
  verb->add_flag("--tree", options->tree, "Draw the skeleton too");
  verb->add_flag("--json", options->json, "Print JSON");
  verb->footer("Examples:\n  panache info walk.bvh\n  panache info models/panache.safetensors");
  verb->callback([options, &exit_code] {
    exit_code = options->file.ends_with(".safetensors")
                    ? model_info(options->file, options->json)
                    : motion_info(options->file, options->tree, options->json);
  });
}

}  // namespace panache::cli
