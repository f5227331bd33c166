// panache info: describes a file and how its rig was mapped.

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "find_inputs.h"
#include "input.h"
#include "learn/recognise.h"
#include "learn/style_file.h"
#include "messages.h"
#include "model_path.h"
#include "model_report.h"
#include "pose/loop.h"
#include "rig/body_motions.h"
#include "rig_options.h"
#include "rig_report.h"
#include "terminal_figures.h"
#include "verbs.h"

namespace panache::cli {
namespace {

// One joint per line, indented below its parent.
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

bool moves(const BodyMotions& body, size_t clip) {
  return std::count(body.clips.begin(), body.clips.end(), static_cast<int>(clip)) > 0;
}

// Whether each motion is a loop.
std::vector<bool> find_loops(const MotionFile& file, const BodyMotions& body,
                             const RigOptions& options) {
  std::vector<bool> loops(file.clip_names().size());
  for (const int c : body.clips) {
    const Clip& clip = file.clip(c);
    const Result<Rig> rig = Rig::create(clip, options);
    loops[static_cast<size_t>(c)] = rig && is_loop(measure_seam(clip, *rig), clip.frame_time);
  }
  return loops;
}

// `shown` is the motion that the rest of the report describes.
std::string describe(const std::string& path, const MotionFile& file, const BodyMotions& body,
                     const std::vector<bool>& loops, size_t shown) {
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
            describe_length(file.clip(static_cast<int>(i))) + (loops[i] ? ", a loop" : "") +
            (moves(body, i)  ? ""
             : body.humanoid ? ", no joint of the humanoid"
                             : ", no joint") +
            (names.size() > 1 && i == shown ? " (shown below)\n" : "\n");
  }
  return text;
}

Json clips_json(const MotionFile& file, const BodyMotions& body, const std::vector<bool>& loops) {
  Json clips = Json::array();
  const std::vector<std::string> names = file.clip_names();
  for (size_t i = 0; i < names.size(); ++i) {
    const Clip& clip = file.clip(static_cast<int>(i));
    clips.push_back({{"name", names[i]},
                     {"frames", clip.frames},
                     {"frame_time", clip.frame_time},
                     {"seconds", clip.duration()},
                     {"moves", moves(body, i)},
                     {"loop", static_cast<bool>(loops[i])}});
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
  std::vector<std::string> files;
  std::string clip;
  ReadOptions read;
  RigFlags rig;
  bool tree = false;
  bool figures = false;
  bool styles = false;
  bool json = false;
};

// What is known of a file, even if it has errors.
struct Info {
  std::string text;
  Json json;
  std::vector<std::string> notes = {};
  std::optional<Error> error = {};
};

// The motion to report on: the requested one, whatever it moves, or else the first that other verbs
// would use. Adds notes and errors about the file to `info`.
size_t pick_shown(const MotionFile& file, const BodyMotions& body, const std::string& path,
                  const InfoVerb& verb, const RigOptions& options, Info& info) {
  const std::vector<std::string> names = file.clip_names();
  const auto asked = std::find(names.begin(), names.end(), verb.clip);
  if (!verb.clip.empty() && asked != names.end()) {
    return static_cast<size_t>(asked - names.begin());
  }
  if (verb.clip.empty() && names.empty()) return 0;
  Result<std::vector<int>> picked = pick_clips(file, verb.clip, options, path, info.notes);
  if (picked) return static_cast<size_t>(picked->front());
  if (!verb.clip.empty() || !body.clips.empty()) throw Failure{picked.error(), kBadInput};
  info.error = picked.error();
  return 0;
}

// The styles recognised in a motion, with a share of at least 0.01.
std::vector<std::pair<std::string, float>> styles_of(const Clip& clip, const Rig& rig,
                                                     const std::shared_ptr<const Model>& remover) {
  constexpr float kMin = 0.01f;
  std::vector<std::pair<std::string, float>> named;
  for (const StyleShare& share : need(recognise_styles(remover, clip, rig))) {
    if (share.share < kMin) continue;
    const bool neutral = share.style < 0;
    named.emplace_back(
        neutral ? "neutral" : remover->styles()[static_cast<size_t>(share.style)].name,
        share.share);
  }
  return named;
}

Info motion_info(const std::string& path, const InfoVerb& verb, const RigOptions& options,
                 const std::shared_ptr<const Model>& remover) {
  const std::unique_ptr<MotionFile> file = need(open_motion(path, verb.read));
  Info info;
  info.notes = file->notes();
  const BodyMotions body = find_body_motions(*file, options);
  const size_t shown = pick_shown(*file, body, path, verb, options, info);
  const Clip& clip = file->clip(static_cast<int>(shown));
  // A file without a humanoid is described too.
  const Result<Rig> rig = make_rig(clip, options, path);
  if (rig) note_rate(clip, *rig, path, info.notes);
  if (!rig && !info.error) info.error = rig.error();
  const std::vector<bool> loops = find_loops(*file, body, options);
  info.json = {{"file", path},
               {"clips", clips_json(*file, body, loops)},
               {"skeleton", skeleton_json(clip.skeleton)},
               {"mapping", rig ? mapping_json(*rig) : Json()},
               {"notes", info.notes},
               {"error", info.error ? Json(info.error->message) : Json()}};
  info.text = describe(path, *file, body, loops, shown);
  if (remover && rig) {
    Json list = Json::array();
    std::string text;
    for (const auto& [name, share] : styles_of(clip, *rig, remover)) {
      list.push_back({{"name", name}, {"share", rounded(static_cast<double>(share))}});
      text += (text.empty() ? "" : ", ") + name + " " + fixed(100 * static_cast<double>(share), 0) +
              " %";
    }
    info.json["styles"] = list;
    info.text += "  styles  " + text + "\n";
  }
  if (rig) info.text += describe_mapping(*rig, options);
  if (verb.figures && rig) info.text += "\n" + draw_figures(clip, *rig);
  if (verb.tree) info.text += "\nSkeleton:\n" + draw_tree(clip.skeleton);
  return info;
}

// The summary that `styles` prints, and the rest of the file's metadata.
Info model_info(const std::string& path) {
  const Result<TensorFile> file = read_tensors(path);
  if (file && is_style_file(*file)) {
    const LoadedStyle style = need(load_style(path));
    return {describe(style), to_json(style)};
  }
  const LoadedModel loaded = need(load_model(path));
  const auto& metadata = loaded.model->metadata();
  Info info{summarize(loaded) + "\nMetadata:\n", to_json(loaded)};
  info.json["metadata"] = metadata;
  for (const auto& [key, value] : metadata) {
    // Already printed above.
    if (key == "styles" || key.starts_with("style_")) continue;
    info.text += "  " + padded(key, 16) + value + "\n";
  }
  return info;
}

// Describes several files one after another; in JSON as a list.
int show(const InfoVerb& verb) {
  need(check_rig_flags(verb.rig), kBadUsage);
  need(check_read_options(verb.read), kBadUsage);
  const RigOptions options = need(read_rig_options(verb.rig));
  std::shared_ptr<const Model> remover;
  if (verb.styles) remover = need(Model::load(need(find_shipped(kRemoverModel))));
  const FoundFiles found = need(find_inputs(verb.files, ""));
  const bool many = found.is_batch || found.files.size() > 1;
  int exit_code = kDone;
  Json list = Json::array();
  std::string between;
  for (const FoundFile& file : found.files) {
    try {
      const Info info = file.path.ends_with(".safetensors")
                            ? model_info(file.path)
                            : motion_info(file.path, verb, options, remover);
      if (!verb.json) print(std::exchange(between, "\n") + info.text);
      if (verb.json && !many) print(info.json);
      print_notes(info.notes);
      if (info.error) exit_code = fail(*info.error, kBadInput);
      list.push_back(info.json);
    } catch (const Failure& failure) {
      exit_code = fail(failure.error, kBadInput);
      list.push_back({{"file", file.path}, {"error", failure.error.message}});
    }
  }
  if (verb.json && many) print(list);
  return exit_code;
}

}  // namespace

void add_info(CLI::App& app, int& exit_code) {
  CLI::App* verb = app.add_subcommand("info",
                                      "Show motion files, how their rigs were mapped, or "
                                      "models");
  auto options = std::make_shared<InfoVerb>();
  verb->add_option("FILE", options->files,
                   "Motion files (" + motion_extensions() +
                       "), folders\nof them, patterns, or models (.safetensors)")
      ->required()
      ->type_name("");
  add_option(*verb, "--clip NAME", options->clip,
             "Motion to infer the rig from, if a file has\nseveral; default: the first");
  add_rig_options(*verb, options->rig);
  add_read_options(*verb, options->read);
  verb->add_flag("--styles", options->styles, "Also tell which styles a motion shows");
  verb->add_flag("--tree", options->tree, "Also draw the skeleton");
  verb->add_flag("--figures", options->figures, "Also draw the motion as stick figures");
  verb->add_flag("--json", options->json, "Print JSON");
  verb->footer(
      "Examples:\n"
      "  panache info walk.bvh\n"
      "  panache info hero.glb --json > hero.json   (edit it, then: --map hero.json)\n"
      "  panache info takes/ --json\n"
      "  panache info walk.bvh --styles\n"
      "  panache info models/panache.safetensors");
  verb->callback([options, &exit_code] { exit_code = show(*options); });
}

}  // namespace panache::cli
