#pragma once
// The report of a batch: JSON lines, written as the files are done.

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

// Everything that may change the results of a batch:
// {"version", "verb", "model": {"file", "sha256"} or null, "options": {"--style": ["old=1"], ...},
// "files": {"--map": sha256, ...}}: the options given to `verb`, without those that choose files
// and messages. `model`: the model file, or empty.
Json batch_settings(const CLI::App& verb, const std::string& model);

// The first line is {"settings": ID, "of": batch_settings()}; then comes a line per finished file.
// Each line is written at once, so that several processes can append to one report.
class BatchReport {
 public:
  // Creates a file, or appends to an existing one if `continues`. Creates missing folders.
  static Result<std::unique_ptr<BatchReport>> open(const std::string& path, const Json& settings,
                                                   bool continues);

  // Adds "settings" to the object and writes it. Thread-safe.
  void add(Json file);
  // Fails if a line could not be written.
  Result<void> close();

 private:
  BatchReport(std::string path, std::FILE* file, std::string id)
      : path_(std::move(path)), file_(file, &std::fclose), id_(std::move(id)) {}
  void put(const Json& line);

  std::string path_;
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
  std::string id_;
  std::mutex mutex_;
  int failure_ = 0;  // errno of the first line that could not be written.
};

// Rejects outputs that the report at `path` lists as made with other settings. A missing report
// rejects nothing.
Result<void> check_settings(const std::string& path, const std::vector<FilePair>& files,
                            const Json& settings);

}  // namespace panache::cli
