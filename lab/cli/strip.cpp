// panache-lab strip: draws motion files as rows of stick figures.

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "base/file.h"
#include "input.h"
#include "messages.h"
#include "outputs.h"
#include "png.h"
#include "draw/strip.h"
#include "rig/posed_rig.h"
#include "rig_options.h"
#include "lab_verbs.h"

namespace panache::cli {
namespace {

// Defaults that fit a page.
constexpr double kDefaultLength = 4;  // Seconds.
constexpr double kLongestTime = 86400;
constexpr int kMaxFigures = 1000;  // Per row.

struct StripVerb {
  std::vector<std::string> inputs, labels;
  std::string output, clip;
  RigFlags rig;
  double every = 0.25;
  double from = 0;
  double to = std::numeric_limits<double>::quiet_NaN();  // Not given.
  bool travel = false;
  bool front = false;
  bool force = false;
};

Result<void> check(StripVerb& verb) {
  const bool has_end = !std::isnan(verb.to);
  for (const Result<void>& checked :
       {check_range("--every", verb.every, 0.01, 60),
        check_range("--from", verb.from, 0, kLongestTime),
        has_end ? check_range("--to", verb.to, 0, kLongestTime) : Result<void>(),
        check_rig_flags(verb.rig)}) {
    if (!checked) return checked;
  }
  if (!has_end) verb.to = verb.from + kDefaultLength;
  if (verb.to < verb.from) {
    return Error{"--to " + brief(verb.to) + ": expected a time after --from " + brief(verb.from)};
  }
  if ((verb.to - verb.from) / verb.every > kMaxFigures) {
    return Error{"--every " + brief(verb.every) + ": expected at most " +
                 std::to_string(kMaxFigures) + " figures from " + brief(verb.from) + " to " +
                 brief(verb.to) + " s"};
  }
  if (!verb.labels.empty() && verb.labels.size() != verb.inputs.size()) {
    return Error{"--label: expected one for each of the " + plural(verb.inputs.size(), "file") +
                 ", found " + std::to_string(verb.labels.size())};
  }
  if (!verb.output.ends_with(".svg") && !verb.output.ends_with(".png")) {
    return Error{verb.output + ": expected a name that ends in .svg or .png"};
  }
  return {};
}

StripRow read_row(const std::string& path, const StripVerb& verb, const RigOptions& options) {
  const std::unique_ptr<MotionFile> file = need(open_motion(path));
  std::vector<std::string> notes = file->notes();
  const std::vector<int> picked = need(pick_clips(*file, verb.clip, options, path, notes));
  print_notes(notes);
  const Clip& clip = file->clip(picked.front());
  const Rig rig = need(make_rig(clip, options, path));
  const double end = (clip.frames - 1) * clip.frame_time;
  if (verb.from > end) {
    throw Failure{{path + ": ends at " + fixed(end, 2) + " s; expected motion from " +
                   brief(verb.from) + " s on"},
                  kBadInput};
  }
  // Skips a calibration pose, which is not part of the motion.
  const double begin = std::max(verb.from, rig.first_frame() * clip.frame_time);
  StripRow row;
  row.label = std::filesystem::path(path).stem().string();
  PosedRig reader(rig);
  std::vector<Quat> rotations(clip.joints());
  std::vector<Vec3> translations(clip.joints());
  for (int i = 0;; ++i) {
    const double seconds = begin + i * verb.every;
    // Half a microsecond: accumulated rounding of frame times in files is smaller.
    if (i > 0 && seconds > std::min(verb.to, end) + 5e-7) break;
    sample(clip, seconds / clip.frame_time, {rotations, translations});
    BodyPose body;
    reader.read({rotations, translations}, body);
    row.frames.push_back(body.joints);
  }
  return row;
}

int strip(StripVerb verb) {
  need(check(verb), kBadUsage);
  const RigOptions rig = need(read_rig_options(verb.rig));
  std::vector<StripRow> rows;
  for (size_t i = 0; i < verb.inputs.size(); ++i) {
    need(check_output(verb.inputs[i], verb.output, verb.force));
    rows.push_back(read_row(verb.inputs[i], verb, rig));
    if (!verb.labels.empty()) rows.back().label = verb.labels[i];
  }
  StripOptions options;
  options.seconds_between = verb.every;
  options.travel = verb.travel;
  if (verb.front) options.yaw_deg = 90;
  std::string picture = draw_strip(rows, options);
  if (verb.output.ends_with(".png")) picture = need(svg_to_png(picture, verb.output));
  need(write_file(verb.output, picture, verb.force));
  print("drew " + plural(rows.size(), "row") + " into " + verb.output + "\n");
  return kDone;
}

}  // namespace

void add_strip(CLI::App& app, int& exit_code) {
  CLI::App* verb = app.add_subcommand("strip", "Draw motion files as a film strip");
  auto options = std::make_shared<StripVerb>();
  verb->add_option("IN", options->inputs,
                   "Motion files (" + motion_extensions() + "),\none row each")
      ->required()
      ->type_name("");
  add_option(*verb, "-o,--output OUT", options->output, "Picture to write (.svg or .png)")
      ->required();
  add_option(*verb, "--every SECONDS", options->every, "Time between figures; default: 0.25");
  add_option(*verb, "--from SECONDS", options->from, "First figure; default: the start");
  add_option(*verb, "--to SECONDS", options->to, "Last figure; default: 4 s after the first");
  add_option(*verb, "--label TEXT", options->labels,
             "Names of the rows; default: those of the files");
  add_option(*verb, "--clip NAME", options->clip,
             "Motion to draw, if a file has several;\ndefault: the first");
  add_rig_options(*verb, options->rig);
  CLI::Option* travel =
      verb->add_flag("--travel", options->travel, "Draw figures where they are along the path");
  verb->add_flag("--front", options->front, "Draw figures from the front")->excludes(travel);
  verb->add_flag("--force", options->force, "Overwrite the picture");
  verb->footer(
      "Example:\n"
      "  panache-lab strip walk.bvh old.bvh -o strip.svg --label 'as captured' 'old = 1'");
  verb->callback([options, &exit_code] { exit_code = strip(*options); });
}

}  // namespace panache::cli
