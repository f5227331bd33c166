#pragma once
// Many files, one after the other or side by side, and one account of them all at the end.

#include <functional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "find_inputs.h"
#include "outputs.h"
#include "messages.h"

namespace panache::cli {

struct BatchFlags {
  std::vector<std::string> inputs;
  std::string output;
  std::string report;  // A file to write, or empty.
  bool force = false;
  bool skip_existing = false;
  bool dry_run = false;
  bool quiet = false;
  bool json = false;
  int jobs = 0;  // 0: one per core.
};

// Gives `verb` inputs, --output, --force, --skip-existing, --dry-run, --jobs, --quiet, --json and
// --report; `flags` must outlive it.
void add_batch_options(CLI::App& verb, BatchFlags& flags);

// One file on its way.
struct FileJob {
  std::string input, output;
  bool skipped = false;            // Its output is there, and stays.
  std::string error;               // Empty where all went well.
  std::vector<std::string> notes;  // What a careful user would want to know; for stderr.
  // Lines that name the motions that are new beside others; printed where there is one file.
  std::vector<std::string> added;
  std::vector<std::string> details;  // Lines to print below the summary, where they are asked for.
  Json clips = Json::array();        // An object for each motion that was worked on.
  int frames = 0;                    // Of the result, all motions together.
  double seconds = 0;                // Likewise.
  Json mapping;                      // Of the rig, null where there was none.
};

// Checks the flags, finds the files and names their outputs, with `extension` where it is not
// empty. A failure sets `exit_code`.
Result<std::vector<FileJob>> plan_batch(const BatchFlags& flags, const std::string& extension,
                                        int& exit_code);

// Does `work` for each file, several at once, under a bar titled DOING, and tells of it: errors and
// notes to stderr, to stdout "DONE walk.bvh into old.bvh ..." or "DONE 18 of 19 files, 1 failed,
// in 3.2 s", or JSON, which also goes into the report. `work` gets a function to call with the
// share of the file that is done. The exit code is 1 where a file failed.
using FileWork = std::function<Result<void>(FileJob&, const std::function<void(double)>&)>;
int run_batch(std::vector<FileJob> files, const BatchFlags& flags, const std::string& doing,
              const std::string& done, const FileWork& work);

}  // namespace panache::cli
