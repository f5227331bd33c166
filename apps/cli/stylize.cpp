// panache stylize: motion files in, the same motion in another style out.

#include <algorithm>
#include <atomic>
#include <chrono>
#include <filesystem>
#include <memory>
#include <mutex>
#include <new>
#include <string>
#include <vector>

#include "base/file.h"
#include "base/parallel.h"
#include "base/progress.h"
#include "clip/motion_file.h"
#include "model_path.h"
#include "outputs.h"
#include "report.h"
#include "rig/rig.h"
#include "strengths.h"
#include "style/restyle.h"
#include "verbs.h"

namespace panache::cli {
namespace {

struct StylizeOptions {
  std::vector<std::string> inputs;
  std::string output;
  std::vector<std::string> styles;
  std::string strengths;  // A CSV, or empty.
  std::string model;
  bool force = false;
  bool json = false;
  bool no_timing = false;
  bool no_feet = false;
  int jobs = 0;
};

// One file on its way.
struct Job {
  std::string input, output;
  std::string error;  // Empty where all went well.
  int frames_in = 0, frames_out = 0;
  double seconds = 0;  // Of the result.
  int joints_mapped = 0;
  std::vector<StrengthTrack> tracks;
};

// One bar for all files.
class JointProgress {
 public:
  explicit JointProgress(size_t files) : bar_("restyling"), shares_(files) {}
  void update(size_t file, double share) {
    const std::lock_guard lock(mutex_);
    total_ += share - shares_[file];
    shares_[file] = share;
    done_ += share == 1;
    const double files = static_cast<double>(shares_.size());
    bar_.update(total_ / files, std::to_string(done_) + " of " + std::to_string(shares_.size()));
  }

 private:
  Progress bar_;
  std::mutex mutex_;
  std::vector<double> shares_;
  double total_ = 0;
  int done_ = 0;
};

std::string ending(const std::string& path) {
  std::string text = std::filesystem::path(path).extension().string();
  for (char& c : text) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return text;
}

Result<void> stylize_file(Job& job, const std::shared_ptr<const Model>& model,
                          const std::vector<StrengthWish>& wishes, const StylizeOptions& options,
                          const std::function<void(double)>& progress) {
  if (auto free = check_output(job.input, job.output, options.force); !free) return free.error();
  Result<std::unique_ptr<MotionFile>> file = read_motion(job.input);
  if (!file) return file.error();
  if (ending(job.output) != ending(job.input)) {
    return Error{job.output + ": expected a name with the input's ending '" + ending(job.input) +
                 "', or a folder (with a '/' at its end)"};
  }
  const Clip& clip = (*file)->clip();
  job.frames_in = clip.frames;
  Result<Rig> rig = Rig::create(clip);
  if (!rig) return Error{job.input + ": " + rig.error().message};
  for (const int joint : rig->joints()) job.joints_mapped += joint >= 0;

  job.tracks =
      tracks_for(wishes, rig->first_frame() * clip.frame_time, (clip.frames - 1) * clip.frame_time);
  RestyleOptions how;
  how.timing = !options.no_timing;
  how.stylizer.foot_lock = !options.no_feet;
  Result<Restyled> restyled = restyle(clip, *rig, model, job.tracks, how, progress);
  if (!restyled) return Error{job.input + ": " + restyled.error().message};
  job.frames_out = restyled->clip.frames;
  job.seconds = restyled->clip.duration();
  return write_file(job.output, (*file)->encode(restyled->clip, restyled->source_frames),
                    options.force);
}

Json to_json(const Job& job, const Model& model) {
  Json styles = Json::array();
  for (const StrengthTrack& track : job.tracks) {
    Json points = Json::array();
    for (const StrengthTrack::Point& point : track.points) {
      points.push_back({{"seconds", point.seconds}, {"strength", point.strength}});
    }
    const std::string& name = model.styles()[static_cast<size_t>(track.style)].name;
    styles.push_back({{"name", name}, {"points", points}});
  }
  const bool ok = job.error.empty();
  return {{"in", job.input},
          {"out", job.output},
          {"ok", ok},
          {"error", ok ? Json() : Json(job.error)},
          {"frames_in", job.frames_in},
          {"frames_out", job.frames_out},
          {"seconds", job.seconds},
          {"styles", styles},
          {"joints_mapped", job.joints_mapped}};
}

// Restyles all jobs and returns how many went well.
size_t run_jobs(std::vector<Job>& jobs, const std::shared_ptr<const Model>& model,
                const std::vector<StrengthWish>& wishes, const StylizeOptions& options) {
  JointProgress progress(jobs.size());
  std::atomic<size_t> good = 0;
  const auto work = [&](int i) {
    const auto n = static_cast<size_t>(i);
    Job& job = jobs[n];
    try {
      const auto share = [&](double done) { progress.update(n, std::min(done, 0.99)); };
      Result<void> done = stylize_file(job, model, wishes, options, share);
      if (!done) job.error = done.error().message;
    } catch (const std::bad_alloc&) {
      job.error = job.input + ": there is not enough memory for it";
    }
    good += job.error.empty();
    progress.update(n, 1);
  };
  parallel_for(static_cast<int>(jobs.size()), work, options.jobs);
  return good;
}

// What the user wants of which style, from both sources. A failure sets `exit_code`.
Result<std::vector<StrengthWish>> collect_wishes(const StylizeOptions& options, const Model& model,
                                                 int& exit_code) {
  exit_code = kBadUsage;
  if (options.styles.empty() && options.strengths.empty()) {
    return Error{"expected a style, as in --style " + model.styles().front().name +
                 "=1, or a table of strengths (--strengths)"};
  }
  Result<std::vector<StrengthWish>> wishes = parse_styles(options.styles, model);
  if (!wishes || options.strengths.empty()) return wishes;
  Result<std::vector<StrengthWish>> table = read_strengths(options.strengths, model);
  if (!table) {
    exit_code = kBadInput;
    return table.error();
  }
  for (StrengthWish& wish : *table) {
    for (const StrengthWish& other : *wishes) {
      if (other.track.style != wish.track.style) continue;
      const std::string& name = model.styles()[static_cast<size_t>(wish.track.style)].name;
      return Error{"style '" + name + "' has strengths both from --style and from " +
                   options.strengths + "; expected one of them"};
    }
  }
  wishes->insert(wishes->end(), table->begin(), table->end());
  return wishes;
}

int stylize(const StylizeOptions& options) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point begin = Clock::now();
  if (auto jobs = check_range("--jobs", options.jobs, 0, 1024); !jobs) {
    return refuse(jobs.error(), kBadUsage);
  }
  Result<std::vector<std::string>> outputs = name_outputs(options.inputs, options.output);
  if (!outputs) return refuse(outputs.error(), kBadUsage);
  Result<std::string> path = find_model(options.model);
  if (!path) return refuse(path.error(), kBadInput);
  Result<std::shared_ptr<const Model>> model = Model::load(*path);
  if (!model) return refuse(model.error(), kBadInput);
  int exit_code = kDone;
  Result<std::vector<StrengthWish>> wishes = collect_wishes(options, **model, exit_code);
  if (!wishes) return refuse(wishes.error(), exit_code);

  std::vector<Job> jobs(options.inputs.size());
  for (size_t i = 0; i < jobs.size(); ++i) {
    jobs[i].input = options.inputs[i];
    jobs[i].output = (*outputs)[i];
  }
  const size_t good = run_jobs(jobs, *model, *wishes, options);
  const double spent = std::chrono::duration<double>(Clock::now() - begin).count();
  Json results = Json::array();
  for (const Job& job : jobs) {
    if (!job.error.empty()) say(job.error);
    if (options.json) results.push_back(to_json(job, **model));
  }
  if (options.json) {
    print(results);
  } else if (jobs.size() > 1) {
    print("restyled " + std::to_string(good) + " of " + plural(jobs.size(), "file") + " in " +
          fixed(spent, 1) + " s\n");
  } else if (good) {
    print("restyled " + jobs[0].input + " into " + jobs[0].output + " (" +
          plural(static_cast<size_t>(jobs[0].frames_out), "frame") + ", " +
          fixed(jobs[0].seconds, 1) + " s) in " + fixed(spent, 1) + " s\n");
  }
  return good == jobs.size() ? kDone : kBadInput;
}

}  // namespace

void add_stylize(CLI::App& app, int& exit_code) {
  CLI::App* verb = app.add_subcommand("stylize", "Restyle motion files");
  auto options = std::make_shared<StylizeOptions>();
  verb->add_option("IN", options->inputs, "Motion files (.bvh)")->required()->type_name("");
  verb->add_option("-o,--output", options->output,
                   "File to write; for several files, or with a '/' at\n"
                   "its end, a folder")
      ->required()
      ->type_name("OUT");
  // One value each, so that files may follow.
  verb->add_option("--style", options->styles,
                   "NAME=STRENGTH: 0 is neutral, 1 the style as captured,\n"
                   "more exaggerates it (-4 to 4). NAME=1..0 changes evenly\n"
                   "from the first frame to the last. One --style per style")
      ->allow_extra_args(false)
      ->type_name("STYLE");
  verb->add_option("--strengths", options->strengths,
                   "CSV with a column 'seconds' and a column per style")
      ->type_name("FILE");
  verb->add_option("--model", options->model,
                   "Model; default: $PANACHE_MODEL, else the one shipped")
      ->type_name("FILE");
  verb->add_flag("--force", options->force, "Overwrite files");
  verb->add_flag("--no-timing", options->no_timing, "Keep the tempo, and so the number of frames");
  verb->add_flag("--no-feet", options->no_feet, "Do not hold planted feet in place");
  verb->add_option("--jobs", options->jobs, "Files at once; default: one per core")->type_name("N");
  verb->add_flag("--json", options->json, "Print what was done with each file as JSON");
  verb->footer(
      "Rig, joint names, channel order and frame rate stay as they are.\n\n"
      "Examples:\n"
      "  panache stylize walk.bvh --style old=1 -o old.bvh\n"
      "  panache stylize takes/*.bvh --style proud=0.7 --style angry=0..1 -o restyled/");
  verb->callback([options, &exit_code] { exit_code = stylize(*options); });
}

}  // namespace panache::cli
