// panache walker: generates a neutral walk, for users without motion data.

#include <memory>
#include <numbers>
#include <string>

#include "base/file.h"
#include "clip/bvh.h"
#include "messages.h"
#include "model_path.h"
#include "outputs.h"
#include "standard_streams.h"
#include "verbs.h"
#include "walker/walker.h"

namespace panache::cli {
namespace {

constexpr double kLongestWalk = 600;  // Seconds.

struct WalkerVerb {
  std::string output, model;
  double seconds = 8, speed = 1.4, turn_deg = 0, fps = 60;
  bool start = false, stop = false, force = false;
};

Result<void> check(const WalkerVerb& verb) {
  const double sharpest =
      static_cast<double>(max_walker_turn(static_cast<float>(verb.speed))) * 180 / std::numbers::pi;
  for (const Result<void>& checked :
       {check_range("--seconds", verb.seconds, 0.1, kLongestWalk),
        check_range("--speed", verb.speed, 0, static_cast<double>(kMaxWalkerSpeed)),
        check_range("--fps", verb.fps, 10, 240)}) {
    if (!checked) return checked;
  }
  if (auto turn = check_range("--turn", verb.turn_deg, -sharpest, sharpest); !turn) {
    return Error{turn.error().message + " at --speed " + brief(verb.speed)};
  }
  if (verb.output != kStandardStream && !verb.output.ends_with(".bvh")) {
    return Error{verb.output + ": expected a name that ends in .bvh"};
  }
  return {};
}

int walk(const WalkerVerb& verb) {
  need(check(verb), kBadUsage);
  const bool to_stdout = verb.output == kStandardStream;
  if (!to_stdout) need(check_output("", verb.output, verb.force));
  const auto model =
      need(WalkerModel::load(verb.model.empty() ? need(find_shipped(kWalkerModel)) : verb.model));
  WalkClipOptions options;
  options.seconds = verb.seconds;
  options.fps = verb.fps;
  options.speed = static_cast<float>(verb.speed);
  options.turn = static_cast<float>(verb.turn_deg * std::numbers::pi / 180);
  options.start = verb.start;
  options.stop = verb.stop;
  const Clip clip = walk_clip(model, options);
  need(to_stdout ? write_stdout(format_bvh(clip))
                 : write_file(verb.output, format_bvh(clip), verb.force));
  if (to_stdout) return kDone;
  print("walked " + fixed(clip.duration(), 1) + " s (" +
        plural(static_cast<size_t>(clip.frames), "frame") + ") into " + verb.output + "\n");
  return kDone;
}

}  // namespace

void add_walker(CLI::App& app, int& exit_code) {
  CLI::App* verb = app.add_subcommand("walker", "Generate a neutral walk as sample input");
  auto options = std::make_shared<WalkerVerb>();
  add_option(*verb, "-o,--output OUT", options->output, "File to write (.bvh); - is stdout")
      ->required();
  add_option(*verb, "--seconds SECONDS", options->seconds, "Duration; default: 8");
  add_option(*verb, "--speed SPEED", options->speed,
             "0 stands, 1.4 walks, 3 runs (m/s); default: 1.4");
  add_option(*verb, "--turn DEGREES", options->turn_deg,
             "To the left (degrees a second); default: 0");
  add_option(*verb, "--fps N", options->fps, "Frames a second; default: 60");
  verb->add_flag("--start", options->start, "Start standing");
  verb->add_flag("--stop", options->stop, "End standing");
  add_option(*verb, "--model FILE", options->model,
             "Model of the walker; default: the one shipped");
  verb->add_flag("--force", options->force, "Overwrite the file");
  verb->footer("Example:\n  panache walker -o walk.bvh --seconds 8 --speed 1.4 --turn 20");
  verb->callback([options, &exit_code] { exit_code = walk(*options); });
}

}  // namespace panache::cli
