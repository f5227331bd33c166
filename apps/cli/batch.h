#pragma once
// Many files, one after the other or side by side, and one account of them all at the end.

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>

#include "clip/motion_file.h"
#include "find_inputs.h"
#include "messages.h"
#include "outputs.h"

namespace panache::cli {

struct BatchFlags {
  std::vector<std::string> inputs;
  std::optional<std::string> output;
  std::string files_from, below;  // A list of files and the folder that they lie in, or empty.
  std::string shard;              // "2/8", or empty.
  std::string to;                 // The format of files in an output folder, or empty.
  std::string report;             // A file to write, or empty.
  const CLI::App* verb = nullptr;
  bool mapping = false;  // In the report.
  bool force = false;
  bool skip_existing = false;
  bool dry_run = false;
  bool quiet = false;
  bool json = false;
  int jobs = 0;  // 0: one per core.
};

// Gives `verb` inputs and the options of a batch; `flags` must outlive it.
void add_batch_options(CLI::App& verb, BatchFlags& flags);

// One file on its way.
struct FileJob : FilePair {
  // Of an input that came through stdin; it is called "stdin.bvh", say.
  std::optional<std::string> bytes;
  bool to_stdout = false;          // It is called "stdout.bvh", say.
  bool stopped = false;            // Ctrl-C came before it was done.
  bool skipped = false;            // Its output is there, and stays.
  std::string error;               // Empty where all went well.
  std::vector<std::string> notes;  // What a careful user would want to know; for stderr.
  // Lines that name the motions that are new beside others; printed where there is one file.
  std::vector<std::string> added;
  std::vector<std::string> facts;    // A line for each motion: what was done to it.
  std::vector<std::string> details;  // Lines to print below the summary, where they are asked for.
  Json clips = Json::array();        // An object for each motion that was worked on.
  int frames = 0;                    // Of the result, all motions together.
  double seconds = 0;                // Likewise.
  Json mapping;                      // Of the rig, null where there was none.
  std::string account;               // All of this as JSON, where it is printed.
};

// How outputs are called that the user did not name.
struct OutputNaming {
  std::string extension;  // In place of the input's own, where it is not empty.
  std::string suffix;     // Between the input's name and its extension, where no --output is given.
};

// Checks the flags, finds the files of this shard, maybe none, and names their outputs; reads stdin
// where that is the input. `model`: its file, or empty. Throws Failure.
std::vector<FileJob> plan_batch(const BatchFlags& flags, const OutputNaming& naming,
                                const std::string& model);

// The motion file of a job, whose notes become those of the job. Throws Failure.
std::unique_ptr<MotionFile> open_input(FileJob& file, const ReadOptions& options);
// Puts the result of a job where it goes. Throws Failure.
void write_output(const FileJob& file, std::string_view bytes, bool force);

// Does `work` for each file, several at once, under a bar titled DOING, and tells of it: errors and
// notes to stderr, to stdout "DONE walk.bvh into old.bvh ..." or "DONE 18 of 19 files, 1 failed,
// in 3.2 s", or JSON. `work` gets a function to call with the share of the file that is done, and
// throws Failure where that file cannot be done;
// `model` is that of plan_batch(). The exit code is 1 where a file failed, and kStopped where
// Ctrl-C came: files that are not done then are left out.
using FileWork = std::function<void(FileJob&, const std::function<void(double)>&)>;
int run_batch(std::vector<FileJob> files, const BatchFlags& flags, const std::string& model,
              const std::string& doing, const std::string& done, const FileWork& work);

}  // namespace panache::cli
