#include "batch.h"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <mutex>
#include <new>

#include "base/file.h"
#include "base/os/os.h"
#include "base/parallel.h"
#include "base/progress.h"
#include "batch_report.h"
#include "formats.h"
#include "input.h"
#include "standard_streams.h"
#include "stop_signal.h"

namespace panache::cli {
namespace {

// One progress bar for all files.
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

// Thrown to stop work on a file after Ctrl-C.
struct Stopped {};

Json to_json(const FileJob& file) {
  const bool ok = file.error.empty() && !file.stopped;
  return {{"in", file.input},
          {"out", file.output},
          {"ok", ok},
          {"skipped", file.skipped},
          {"error", ok ? Json() : Json(file.stopped ? "stopped" : file.error)},
          {"clips", file.clips},
          {"frames", file.frames},
          {"seconds", file.seconds},
          {"mapping", file.mapping},
          {"notes", file.notes}};
}

// The same for the report, where the settings name the styles.
Json report_of(const FileJob& file, bool mapping) {
  Json object = to_json(file);
  if (!mapping) object.erase("mapping");
  for (Json& clip : object["clips"]) clip.erase("styles");
  return object;
}

// Prints the objects of all files as dump() prints a list, piece by piece.
void print_accounts(const std::vector<FileJob>& files) {
  std::string before = "[\n  ";
  for (const FileJob& file : files) {
    const std::string object = file.account.empty() ? dump(to_json(file)) : file.account;
    std::string text = before;
    for (const char letter : std::string_view(object).substr(0, object.size() - 1)) {
      text += letter;
      if (letter == '\n') text += "  ";
    }
    print(text);
    before = ",\n  ";
  }
  print(std::string(files.empty() ? "[]\n" : "\n]\n"));
}

std::string summary(const std::vector<FileJob>& files, const std::string& done, double spent) {
  const std::string in = " in " + fixed(spent, 1) + " s\n";
  const auto failed = std::count_if(files.begin(), files.end(),
                                    [](const FileJob& file) { return !file.error.empty(); });
  const auto skipped =
      std::count_if(files.begin(), files.end(), [](const FileJob& file) { return file.skipped; });
  const auto stopped =
      std::count_if(files.begin(), files.end(), [](const FileJob& file) { return file.stopped; });
  const auto good = static_cast<std::ptrdiff_t>(files.size()) - failed - skipped - stopped;
  if (stopped) {
    return "stopped: " + done + " " + std::to_string(good) + " of " + plural(files.size(), "file") +
           in.substr(0, in.size() - 1) +
           (good ? "; --skip-existing goes on with the rest\n" : "\n");
  }
  if (files.size() != 1) {
    return done + " " + std::to_string(good) + " of " + plural(files.size(), "file") +
           (failed ? ", " + std::to_string(failed) + " failed" : "") +
           (skipped ? ", " + std::to_string(skipped) + " skipped" : "") +
           (failed || skipped ? "," : "") + in;
  }
  if (failed) return "";
  const FileJob& file = files[0];
  if (skipped) return "skipped " + file.input + ": " + file.output + " exists already\n";
  return done + " " + file.input + " into " + file.output + " (" +
         plural(static_cast<size_t>(file.frames), "frame") + ", " + fixed(file.seconds, 1) + " s)" +
         in;
}

// Processes one file and keeps its messages for the end.
void run_file(FileJob& file, const BatchFlags& flags, const FileWork& work,
              const std::function<void(double)>& show) {
  std::error_code status;
  const auto is_taken = [&] {
    return flags.skip_existing && !file.to_stdout && std::filesystem::exists(file.output, status);
  };
  file.skipped = file.skipped || is_taken();
  if (file.skipped) return show(1);
  const auto share = [&](double part) {
    if (stop_asked()) throw Stopped();
    show(std::min(part, 0.99));
  };
  try {
    share(0);
    work(file, share);
  } catch (const Failure& failure) {
    if (stop_asked()) {  // Ctrl-C interrupted a wait or a child process.
      file.stopped = true;
      return;
    }
    if (is_taken()) {  // Another process wrote it meanwhile, and reports it.
      FileJob skipped;
      static_cast<FilePair&>(skipped) = file;
      skipped.skipped = true;
      file = std::move(skipped);
    } else {
      file.error = with_hint(failure.error);
      file.details.clear();
    }
  } catch (const std::bad_alloc&) {
    file.error = file.input + ": out of memory";
  } catch (const Stopped&) {
    file.stopped = true;
    return;
  }
  show(1);
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
  print(json ? dump(plan) : text);
  return kDone;
}

}  // namespace

void add_batch_options(CLI::App& verb, BatchFlags& flags) {
  verb.add_option("IN", flags.inputs,
                  "Motion files (" + motion_extensions() +
                      "),\nfolders of them, or patterns such as 'takes/**/*.bvh';\n"
                      "- is stdin")
      ->type_name("");
  flags.verb = &verb;
  add_option(verb, "-o,--output OUT", flags.output,
             "File to write; for several files, or with a '/' at\n"
             "its end, a folder; - is stdout. Default for one file:\n"
             "a new name beside it");
  add_option(verb, "--to FORMAT", flags.to,
             list_writable_names() + ": the format of files if OUT is a folder");
  CLI::Option* list =
      add_option(verb, "--files-from LIST", flags.files_from,
                 "Text file with the name of a motion file in each line;\n- is stdin");
  add_option(verb, "--below FOLDER", flags.below,
             "Folder that the files of LIST lie in: their results have\n"
             "the same folders below OUT")
      ->needs(list);
  add_option(verb, "--shard I/N", flags.shard,
             "Work on the I-th of N parts of the files, I from 1 to N:\n"
             "one for each machine");
  CLI::Option* force = verb.add_flag("--force", flags.force, "Overwrite files");
  verb.add_flag("--skip-existing", flags.skip_existing,
                "Skip inputs whose output exists (resume a batch)")
      ->excludes(force);
  verb.add_flag("--dry-run", flags.dry_run, "Only show what would be written; reads no motion");
  add_option(verb, "--jobs N", flags.jobs, "Files processed in parallel; default: one per core");
  CLI::Option* quiet = verb.add_flag("--quiet", flags.quiet, "Print only errors, without progress");
  verb.add_flag("--json", flags.json, "Print the result for each file as JSON")->excludes(quiet);
  CLI::Option* report = add_option(verb, "--report FILE", flags.report,
                                   "Write a line of JSON for each file that is done;\n"
                                   "with --skip-existing, add to those that are there");
  verb.add_flag("--mapping", flags.mapping, "With the mapping of each rig in the report")
      ->needs(report);
}

std::unique_ptr<MotionFile> open_input(FileJob& file, const ReadOptions& options) {
  if (file.bytes && becomes_glb(file.input, file.output)) {
    throw Failure{
        {file.input + ": is FBX, which becomes GLB if it is read by name; expected another "
                      "format, or a file"},
        kBadInput};
  }
  auto motion = need(file.bytes ? find_format(formats(), extension_of(file.input))
                                      ->parse(*file.bytes, file.input, options)
                                : open_motion(file.input, options, file.output));
  file.notes = motion->notes();
  return motion;
}

void write_output(const FileJob& file, std::string_view bytes, bool force) {
  need(file.to_stdout ? write_stdout(bytes) : write_file(file.output, bytes, force));
}

int run_batch(std::vector<FileJob> files, const BatchFlags& flags, const std::string& model,
              const std::string& doing, const std::string& done, const FileWork& work) {
  if (flags.dry_run) return tell_plan(files, flags.json);
  std::unique_ptr<BatchReport> report;
  if (!flags.report.empty()) {
    report = need(
        BatchReport::open(flags.report, batch_settings(*flags.verb, model), flags.skip_existing));
  }
  watch_stop_signals();
  using Clock = std::chrono::steady_clock;
  const Clock::time_point begin = Clock::now();
  {
    JointProgress progress(doing, files.size());
    // Processes that share a tree start at different files, or all would do the same work.
    const size_t first =
        flags.skip_existing && !files.empty() ? process_number() * 7919 % files.size() : 0;
    const auto run = [&](int i) {
      const size_t n = (static_cast<size_t>(i) + first) % files.size();
      FileJob& file = files[n];
      run_file(file, flags, work, [&](double part) {
        if (!flags.quiet) progress.update(n, part);
      });
      if (report) report->add(report_of(file, flags.mapping));
      if (flags.json) {
        file.account = dump(to_json(file));
        file.account.shrink_to_fit();  // Saves 160 MB with ten thousand files.
      }
      file.bytes.reset();
      file.clips = file.mapping = Json();
    };
    parallel_for(static_cast<int>(files.size()), run, flags.jobs);
  }
  const double spent = std::chrono::duration<double>(Clock::now() - begin).count();

  bool all_good = true, stopped = false;
  // If the motion goes to stdout, the messages go to stderr.
  const auto tell = [&](const std::string& text) {
    if (!files.empty() && files[0].to_stdout) {
      std::fputs(text.c_str(), stderr);
    } else {
      print(text);
    }
  };
  for (const FileJob& file : files) {
    for (const std::string& note : file.notes) {
      if (!flags.quiet) print_message(note);
    }
    if (!file.error.empty()) print_message(file.error);
    all_good = all_good && file.error.empty() && !file.stopped;
    stopped = stopped || file.stopped;
  }
  if (flags.json) {
    print_accounts(files);
  } else if (!flags.quiet) {
    tell(summary(files, done, spent));
    if (files.size() == 1 && all_good) {
      for (const std::string& line : files[0].added) tell("  " + line + "\n");
    }
    for (const FileJob& file : files) {
      if (file.error.empty() && !stopped) {
        for (const std::string& line : file.facts) tell("  " + line + "\n");
      }
      for (const std::string& line : file.details) tell("  " + line + "\n");
    }
  }
  if (report) need(report->close());
  return stopped ? kStopped : all_good ? kDone : kBadInput;
}

}  // namespace panache::cli
