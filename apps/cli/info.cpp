// panache info: what a file is, and how its rig was understood.

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "input.h"
#include "learn/style_file.h"
#include "messages.h"
#include "model_edit.h"
#include "model_report.h"
#include "rig_options.h"
#include "rig_report.h"
#include "verbs.h"

namespace panache::cli {
namespace {

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

std::string describe_length(const Clip& clip) {
  return plural(static_cast<size_t>(clip.frames), "frame") + " at " + brief(1 / clip.frame_time) +
         " a second: " + fixed(clip.duration(), 2) + " s";
}

// `shown` is the motion that the rest of the report is about.
std::string describe(const std::string& path, const MotionFile& file, size_t shown) {
  const std::vector<std::string> names = file.clip_names();
  const std::vector<Joint>& joints = file.clip(static_cast<int>(shown)).skeleton.joints;
  const auto rotating = std::count_if(joints.begin(), joints.end(),
                                      [](const Joint& joint) { return joint.can_rotate; });
  const auto moving = std::count_if(joints.begin(), joints.end(),
                                    [](const Joint& joint) { return joint.can_translate; });
  std::string text = path + "\n";
  text += "  joints  " + std::to_string(joints.size()) + ", of which " + std::to_string(rotating) +
          " rotate and " + std::to_string(moving) + " move\n";
  if (names.empty()) text += "  motion  none: the following describes the rest pose\n";
  size_t width = 0;
  for (const std::string& name : names) width = std::max(width, name.size());
  for (size_t i = 0; i < names.size(); ++i) {
    text += "  motion  " + (width ? padded(names[i], width + 2) : "") +
            describe_length(file.clip(static_cast<int>(i))) +
            (names.size() > 1 && i == shown ? " (shown below)\n" : "\n");
  }
  return text;
}

Json clips_json(const MotionFile& file) {
  Json clips = Json::array();
  const std::vector<std::string> names = file.clip_names();
  for (size_t i = 0; i < names.size(); ++i) {
    const Clip& clip = file.clip(static_cast<int>(i));
    clips.push_back({{"name", names[i]},
                     {"frames", clip.frames},
                     {"frame_time", clip.frame_time},
                     {"seconds", clip.duration()}});
  }
  return clips;
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

struct InfoVerb {
  std::string file, clip;
  RigFlags rig;
  bool tree = false;
  bool json = false;
};

int motion_info(const InfoVerb& verb) {
  if (auto flags = check_rig_flags(verb.rig); !flags) return fail(flags.error(), kBadUsage);
  Result<RigOptions> options = read_rig_options(verb.rig);
  if (!options) return fail(options.error(), kBadInput);
  Result<std::unique_ptr<MotionFile>> file = open_motion(verb.file);
  if (!file) return fail(file.error(), kBadInput);
  size_t shown = 0;
  if (!verb.clip.empty() || !(*file)->clip_names().empty()) {
    Result<std::vector<int>> picked = pick_clips(**file, verb.clip, verb.file);
    if (!picked) return fail(picked.error(), kBadInput);
    shown = static_cast<size_t>(picked->front());
  }
  const Clip& clip = (*file)->clip(static_cast<int>(shown));
  // A file that is no humanoid is still a file that one may want to look at.
  const Result<Rig> rig = make_rig(clip, *options, verb.file);
  if (verb.json) {
    print(Json{{"file", verb.file},
               {"clips", clips_json(**file)},
               {"skeleton", skeleton_json(clip.skeleton)},
               {"mapping", rig ? mapping_json(*rig) : Json()},
               {"error", rig ? Json() : Json(rig.error().message)}});
  } else {
    print(describe(verb.file, **file, shown));
    if (rig) print(describe_mapping(*rig, *options));
    if (verb.tree) print("\nSkeleton:\n" + draw_tree(clip.skeleton));
  }
  return rig ? kDone : fail(rig.error(), kBadInput);
}

// As styles, and all else that the file says of itself.
int model_info(const std::string& path, bool json) {
  const Result<TensorFile> file = read_tensors(path);
  if (file && is_style_file(*file)) return report(load_style(path), json);
  Result<LoadedModel> loaded = load_model(path);
  if (!loaded) return fail(loaded.error(), kBadInput);
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
    if (key == "styles" || key == "style_descriptions" || key == "style_origins") continue;
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
  auto options = std::make_shared<InfoVerb>();
  verb->add_option("FILE", options->file,
                   "Motion file (" + motion_extensions() + ")\nor model (.safetensors)")
      ->required()
      ->type_name("");
  verb->add_option("--clip", options->clip,
                   "Motion to infer the rig from, if a file has\nseveral; default: the first")
      ->type_name("NAME");
  add_rig_options(*verb, options->rig);
  verb->add_flag("--tree", options->tree, "Also draw the skeleton");
  verb->add_flag("--json", options->json, "Print JSON");
  verb->footer(
      "Examples:\n"
      "  panache info walk.bvh\n"
      "  panache info hero.glb --json > hero.json   (edit it, then: --map hero.json)\n"
      "  panache info models/panache.safetensors");
  verb->callback([options, &exit_code] {
    exit_code = options->file.ends_with(".safetensors") ? model_info(options->file, options->json)
                                                        : motion_info(*options);
  });
}

}  // namespace panache::cli
