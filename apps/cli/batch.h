#pragma once
// Processes many files, one by one or in parallel, and reports on all of them at the end.

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
  std::string files_from, below;  // A list of files and the folder that contains them, or empty.
  std::string shard;              // "2/8", or empty.
  std::string to;                 // The format of files in an output folder, or empty.
  std::string report;             // A file to write, or empty.
  const CLI::App* verb = nullptr;
  bool mapping = false;  // Include the joint mapping in the report.
  bool force = false;
  bool skip_existing = false;
  bool dry_run = false;
  bool quiet = false;
  bool json = false;
  int jobs = 0;  // 0: one per core.
};

// Gives `verb` inputs and the options of a batch; `flags` must outlive it.
void add_batch_options(CLI::App& verb, BatchFlags& flags);

// The work on one file.
struct FileJob : FilePair {
  // The content of an input read from stdin, which is then named "stdin.bvh" or similar.
  std::optional<std::string> bytes;
  bool to_stdout = false;          // The output is then named "stdout.bvh" or similar.
  bool stopped = false;            // Ctrl-C came before the file was done.
  bool skipped = false;            // The output already exists and is kept.
  std::string error;               // Empty on success.
  std::vector<std::string> notes;  // Warnings for stderr.
  // Lines that name the added motions; printed if there is only one file.
  std::vector<std::string> added;
  std::vector<std::string> facts;    // One line per motion: what was done to it.
  std::vector<std::string> details;  // Lines to print below the summary, on request.
  Json clips = Json::array();        // One object per processed motion.
  int frames = 0;                    // Total frames of all resulting motions.
  double seconds = 0;                // Total duration of all resulting motions.
  Json mapping;                      // The rig's joint mapping; null without one.
  std::string account;               // All of this as JSON, if JSON is printed.
};

// How to name outputs that the user did not name.
struct OutputNaming {
  std::string extension;  // Replaces the input's extension unless empty.
  std::string suffix;     // Goes between the input's name and its extension, without --output.
};

// Checks the flags, finds the files of this shard (possibly none) and names their outputs; reads
// stdin if it is the input. `model`: the model file, or empty. Throws Failure.
std::vector<FileJob> plan_batch(const BatchFlags& flags, const OutputNaming& naming,
                                const std::string& model);

// Opens the motion file of a job and adds its notes to the job's. Throws Failure.
std::unique_ptr<MotionFile> open_input(FileJob& file, const ReadOptions& options);
// Writes the result of a job to its output. Throws Failure.
void write_output(const FileJob& file, std::string_view bytes, bool force);

// Does `work` on several files at once, with a progress bar titled DOING. Prints errors and notes
// to stderr, and to stdout "DONE walk.bvh into old.bvh ..." or "DONE 18 of 19 files, 1 failed, in
// 3.2 s", or JSON. `work` reports its progress (0 to 1) through the function it gets, and throws
// Failure if the file fails. `model` as for plan_batch(). The exit code is 1 if a file failed, and
// kStopped after Ctrl-C, which drops unfinished files.
using FileWork = std::function<void(FileJob&, const std::function<void(double)>&)>;
int run_batch(std::vector<FileJob> files, const BatchFlags& flags, const std::string& model,
              const std::string& doing, const std::string& done, const FileWork& work);

}  // namespace panache::cli
