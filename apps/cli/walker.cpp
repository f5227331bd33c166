// panache walker: a neutral walk of our own making, for machines without motion data.

#include <memory>
#include <numbers>
#include <string>
#include <vector>

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
  if (auto good = check(verb); !good) return fail(good.error(), kBadUsage);
  const bool to_stdout = verb.output == kStandardStream;
  if (auto free = check_output("", verb.output, verb.force); !free && !to_stdout) {
    return fail(free.error(), kBadInput);
  }
  Result<std::string> path =
      verb.model.empty() ? find_shipped(kWalkerModel) : Result<std::string>(verb.model);
  if (!path) return fail(path.error(), kBadInput);
  Result<std::shared_ptr<const WalkerModel>> model = WalkerModel::load(*path);
  if (!model) return fail(model.error(), kBadInput);
  WalkClipOptions options;
  options.seconds = verb.seconds;
  options.fps = verb.fps;
  options.speed = static_cast<float>(verb.speed);
  options.turn = static_cast<float>(verb.turn_deg * std::numbers::pi / 180);
  options.start = verb.start;
  options.stop = verb.stop;
  const Clip clip = walk_clip(*model, options);
  auto written = to_stdout ? write_stdout(format_bvh(clip))
                           : write_file(verb.output, format_bvh(clip), verb.force);
  if (!written) return fail(written.error(), kBadInput);
  if (to_stdout) return kDone;
  print("walked " + fixed(clip.duration(), 1) + " s (" +
        plural(static_cast<size_t>(clip.frames), "frame") + ") into " + verb.output + "\n");
  return kDone;
}

}  // namespace

void add_walker(CLI::App& app, int& exit_code) {
  CLI::App* verb = app.add_subcommand("walker", "Generate a neutral walk as sample input");
  auto options = std::make_shared<WalkerVerb>();
  verb->add_option("-o,--output", options->output, "File to write (.bvh); - is stdout")
      ->required()
      ->type_name("OUT");
  verb->add_option("--seconds", options->seconds, "Duration; default: 8")->type_name("SECONDS");
  verb->add_option("--speed", options->speed, "0 stands, 1.4 walks, 3 runs (m/s); default: 1.4")
      ->type_name("SPEED");
  verb->add_option("--turn", options->turn_deg, "To the left (degrees a second); default: 0")
      ->type_name("DEGREES");
  verb->add_option("--fps", options->fps, "Frames a second; default: 60")->type_name("N");
  verb->add_flag("--start", options->start, "Start standing");
  verb->add_flag("--stop", options->stop, "End standing");
  verb->add_option("--model", options->model, "Model of the walker; default: the one shipped")
      ->type_name("FILE");
  verb->add_flag("--force", options->force, "Overwrite the file");
  verb->footer("Example:\n  panache walker -o walk.bvh --seconds 8 --speed 1.4 --turn 20");
  verb->callback([options, &exit_code] { exit_code = walk(*options); });
}

}  // namespace panache::cli
