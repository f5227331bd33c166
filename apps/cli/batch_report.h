#pragma once
// The report of a batch: lines of JSON that grow while it works.

#include <cstdio>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "base/result.h"
#include "messages.h"
#include "outputs.h"

namespace panache::cli {

// What a batch is made with, all that may change its results:
// {"version", "verb", "model": {"file", "sha256"} or null, "options": {"--style": ["old=1"], ...},
// "files": {"--map": sha256, ...}}: the options given to `verb`, without those that choose files
// and messages. `model`: its file, or empty.
Json batch_settings(const CLI::App& verb, const std::string& model);

// {"settings": ID, "of": batch_settings()} comes first, then a line for each file that is done.
// Each line is written at once, so that several processes may add to one report.
class BatchReport {
 public:
  // A new file, or, where it `continues`, lines at the end of one that exists. Missing folders are
  // made.
  static Result<std::unique_ptr<BatchReport>> open(const std::string& path, const Json& settings,
                                                   bool continues);

  // Adds "settings" to the object of a file. Threads may call it at once.
  void add(Json file);
  // Fails where a line could not be written.
  Result<void> close();

 private:
  BatchReport(std::string path, std::FILE* file, std::string id)
      : path_(std::move(path)), file_(file, &std::fclose), id_(std::move(id)) {}
  void put(const Json& line);

  std::string path_;
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
  std::string id_;
  std::mutex mutex_;
  int failure_ = 0;  // errno of the first line that was not written.
};

// Rejects outputs that the report at `path` names as made with other settings. A report that is not
// there rejects nothing.
Result<void> check_settings(const std::string& path, const std::vector<FilePair>& files,
                            const Json& settings);

}  // namespace panache::cli
