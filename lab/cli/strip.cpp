// panache-lab strip: motion files as a picture, one row of stick figures each.

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

// What fits a page beside others, unless one asks for more.
constexpr double kDefaultLength = 4;  // Seconds.
constexpr double kLongestTime = 86400;
constexpr int kMaxFigures = 1000;  // In a row.

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

Result<StripRow> read_row(const std::string& path, const StripVerb& verb,
                          const RigOptions& options) {
  Result<std::unique_ptr<MotionFile>> file = open_motion(path);
  if (!file) return file.error();
  std::vector<std::string> notes = (*file)->notes();
  Result<std::vector<int>> picked = pick_clips(**file, verb.clip, options, path, notes);
  if (!picked) return picked.error();
  print_notes(notes);
  const Clip& clip = (*file)->clip(picked->front());
  Result<Rig> rig = make_rig(clip, options, path);
  if (!rig) return rig.error();
  const double end = (clip.frames - 1) * clip.frame_time;
  if (verb.from > end) {
    return Error{path + ": ends at " + fixed(end, 2) + " s; expected motion from " +
                 brief(verb.from) + " s on"};
  }
  // A calibration pose is no part of the motion.
  const double begin = std::max(verb.from, rig->first_frame() * clip.frame_time);
  StripRow row;
  row.label = std::filesystem::path(path).stem().string();
  PosedRig reader(*rig);
  std::vector<Quat> rotations(clip.joints());
  std::vector<Vec3> translations(clip.joints());
  for (int i = 0;; ++i) {
    const double seconds = begin + i * verb.every;
    // Half a microsecond: what frame times in files are rounded to adds up to less.
    if (i > 0 && seconds > std::min(verb.to, end) + 5e-7) break;
    sample(clip, seconds / clip.frame_time, {rotations, translations});
    BodyPose body;
    reader.read({rotations, translations}, body);
    row.frames.push_back(body.joints);
  }
  return row;
}

int strip(StripVerb verb) {
  if (auto good = check(verb); !good) return fail(good.error(), kBadUsage);
  Result<RigOptions> rig = read_rig_options(verb.rig);
  if (!rig) return fail(rig.error(), kBadInput);
  std::vector<StripRow> rows;
  for (size_t i = 0; i < verb.inputs.size(); ++i) {
    auto free = check_output(verb.inputs[i], verb.output, verb.force);
    if (!free) return fail(free.error(), kBadInput);
    Result<StripRow> row = read_row(verb.inputs[i], verb, *rig);
    if (!row) return fail(row.error(), kBadInput);
    if (!verb.labels.empty()) row->label = verb.labels[i];
    rows.push_back(*std::move(row));
  }
  StripOptions options;
  options.seconds_between = verb.every;
  options.travel = verb.travel;
  if (verb.front) options.yaw_deg = 90;
  Result<std::string> picture = draw_strip(rows, options);
  if (verb.output.ends_with(".png")) picture = svg_to_png(*picture, verb.output);
  if (!picture) return fail(picture.error(), kBadInput);
  auto written = write_file(verb.output, *picture, verb.force);
  if (!written) return fail(written.error(), kBadInput);
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
  verb->add_option("-o,--output", options->output, "Picture to write (.svg or .png)")
      ->required()
      ->type_name("OUT");
  verb->add_option("--every", options->every, "Time between figures; default: 0.25")
      ->type_name("SECONDS");
  verb->add_option("--from", options->from, "First figure; default: the start")
      ->type_name("SECONDS");
  verb->add_option("--to", options->to, "Last figure; default: 4 s after the first")
      ->type_name("SECONDS");
  verb->add_option("--label", options->labels, "Names of the rows; default: those of the files")
      ->type_name("TEXT");
  verb->add_option("--clip", options->clip,
                   "Motion to draw, if a file has several;\ndefault: the first")
      ->type_name("NAME");
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
