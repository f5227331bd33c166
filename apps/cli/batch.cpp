#include "batch.h"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <filesystem>
#include <mutex>
#include <new>

#include "base/file.h"
#include "base/parallel.h"
#include "base/progress.h"
#include "input.h"

namespace panache::cli {
namespace {

// One bar for all files.
class JointProgress {
 public:
  JointProgress(const std::string& title, size_t files) : bar_(title), shares_(files) {}
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

Json to_json(const FileJob& file) {
  const bool ok = file.error.empty();
  return {{"in", file.input},
          {"out", file.output},
          {"ok", ok},
          {"skipped", file.skipped},
          {"error", ok ? Json() : Json(file.error)},
          {"clips", file.clips},
          {"frames", file.frames},
          {"seconds", file.seconds},
          {"mapping", file.mapping},
          {"notes", file.notes}};
}

std::string summary(const std::vector<FileJob>& files, const std::string& done, double spent) {
  const std::string in = " in " + fixed(spent, 1) + " s\n";
  const auto failed = std::count_if(files.begin(), files.end(),
                                    [](const FileJob& file) { return !file.error.empty(); });
  const auto skipped =
      std::count_if(files.begin(), files.end(), [](const FileJob& file) { return file.skipped; });
  if (files.size() > 1) {
    const auto good = static_cast<std::ptrdiff_t>(files.size()) - failed - skipped;
    return done + " " + std::to_string(good) + " of " + plural(files.size(), "file") +
           (failed ? ", " + std::to_string(failed) + " failed," : "") +
           (skipped ? ", " + std::to_string(skipped) + " skipped," : "") + in;
  }
  if (failed) return "";
  const FileJob& file = files[0];
  if (skipped) return "skipped " + file.input + ": " + file.output + " exists already\n";
  return done + " " + file.input + " into " + file.output + " (" +
         plural(static_cast<size_t>(file.frames), "frame") + ", " + fixed(file.seconds, 1) + " s)" +
         in;
}

int tell_plan(const std::vector<FileJob>& files, bool json) {
  Json plan = Json::array();
  std::string text;
  for (const FileJob& file : files) {
    plan.push_back({{"in", file.input}, {"out", file.output}, {"skipped", file.skipped}});
    text += (file.skipped ? "would skip " + file.input + ": " + file.output + " exists already"
                          : "would write " + file.output + " from " + file.input) +
            "\n";
  }
  if (json) {
    print(plan);
  } else {
    print(text);
  }
  return kDone;
}

}  // namespace

void add_batch_options(CLI::App& verb, BatchFlags& flags) {
  verb.add_option("IN", flags.inputs,
                  "Motion files (" + motion_extensions() +
                      "),\nfolders of them, or patterns such as 'takes/**/*.bvh'")
      ->required()
      ->type_name("");
  verb.add_option("-o,--output", flags.output,
                  "File to write; for several files, or with a '/' at\n"
                  "its end, a folder")
      ->required()
      ->type_name("OUT");
  CLI::Option* force = verb.add_flag("--force", flags.force, "Overwrite files");
  verb.add_flag("--skip-existing", flags.skip_existing,
                "Leave out what has an output already, as to go on\nwith a batch")
      ->excludes(force);
  verb.add_flag("--dry-run", flags.dry_run, "Only show what would be written; reads no motion");
  verb.add_option("--jobs", flags.jobs, "Files processed in parallel; default: one per core")
      ->type_name("N");
  CLI::Option* quiet =
      verb.add_flag("--quiet", flags.quiet, "Print nothing but errors, and show no progress");
  verb.add_flag("--json", flags.json, "Print the result for each file as JSON")->excludes(quiet);
  verb.add_option("--report", flags.report, "Also write this JSON to a file")->type_name("FILE");
}

Result<std::vector<FileJob>> plan_batch(const BatchFlags& flags, const std::string& extension,
                                        int& exit_code) {
  exit_code = kBadUsage;
  if (auto jobs = check_range("--jobs", flags.jobs, 0, 1024); !jobs) return jobs.error();
  Result<FoundFiles> found = find_inputs(flags.inputs, flags.output);
  if (!found) {
    exit_code = kBadInput;
    return found.error();
  }
  Result<std::vector<FilePair>> pairs = name_outputs(*found, flags.output, extension);
  if (!pairs) return pairs.error();
  std::vector<FileJob> files;
  for (const FilePair& pair : *pairs) {
    FileJob file;
    file.input = pair.input;
    file.output = pair.output;
    files.push_back(std::move(file));
    if (!flags.report.empty() && pair.output == flags.report) {
      return Error{"--report: " + flags.report + " is an output too; expected a separate file"};
    }
  }
  exit_code = kBadInput;
  if (!flags.report.empty()) {
    if (auto free = check_output("", flags.report, flags.force); !free) return free.error();
  }
  if (flags.skip_existing) {
    std::error_code status;
    for (FileJob& file : files) file.skipped = std::filesystem::exists(file.output, status);
  } else if (auto free = check_outputs(*pairs, flags.force); !free) {
    return free.error();
  }
  return files;
}

int run_batch(std::vector<FileJob> files, const BatchFlags& flags, const std::string& doing,
              const std::string& done, const FileWork& work) {
  if (flags.dry_run) return tell_plan(files, flags.json);
  using Clock = std::chrono::steady_clock;
  const Clock::time_point begin = Clock::now();
  {
    JointProgress progress(doing, files.size());
    const auto run = [&](int i) {
      const auto n = static_cast<size_t>(i);
      FileJob& file = files[n];
      const auto show = [&](double part) {
        if (!flags.quiet) progress.update(n, part);
      };
      if (file.skipped) return show(1);
      try {
        const auto share = [&](double part) { show(std::min(part, 0.99)); };
        if (auto worked = work(file, share); !worked)
          file.error = with_hint(worked.error().message);
      } catch (const std::bad_alloc&) {
        file.error = file.input + ": out of memory";
      }
      show(1);
    };
    parallel_for(static_cast<int>(files.size()), run, flags.jobs);
  }
  const double spent = std::chrono::duration<double>(Clock::now() - begin).count();

  Json results = Json::array();
  bool all_good = true;
  for (const FileJob& file : files) {
    for (const std::string& note : file.notes) {
      if (!flags.quiet) print_message(note);
    }
    if (!file.error.empty()) print_message(file.error);
    all_good = all_good && file.error.empty();
    results.push_back(to_json(file));
  }
  if (flags.json) {
    print(results);
  } else if (!flags.quiet) {
    print(summary(files, done, spent));
    if (files.size() == 1 && all_good) {
      for (const std::string& line : files[0].added) print("  " + line + "\n");
    }
    for (const FileJob& file : files) {
      for (const std::string& line : file.details) print("  " + line + "\n");
    }
  }
  if (!flags.report.empty()) {
    auto written = write_file(flags.report, dump(results), flags.force);
    if (!written) return fail(written.error(), kBadInput);
  }
  return all_good ? kDone : kBadInput;
}

}  // namespace panache::cli
