#pragma once
// Manifests on the command line: shared by train and eval.

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "base/result.h"
#include "learn/manifest.h"

namespace panache::cli {

struct ManifestOptions {
  std::vector<std::string> paths;
  std::string styles;  // CSV of style names, or empty.
  std::vector<std::string> unlabelled;
};
// Returns the positional option of the manifests themselves.
CLI::Option* add_manifest_options(CLI::App& verb, ManifestOptions& options);

struct Manifests {
  std::vector<ManifestRow> rows;  // Styles renamed.
  std::vector<StyleName> styles;
  std::vector<ManifestRow> unlabelled;  // Motion without styles, for training.
  std::vector<std::string> left_out;    // A sentence for each style that is not used.
};
Result<Manifests> read_manifests(const ManifestOptions& options);

// The rows of both that are not marked test.
std::vector<ManifestRow> rows_to_train_on(const std::vector<ManifestRow>& rows,
                                          const std::vector<ManifestRow>& unlabelled);

// Names all files of `rows` that do not exist, each in a message of its own, and fails where there
// are any.
Result<void> check_files(const std::vector<ManifestRow>& rows);

// Rejects an output that exists, unless `force`.
Result<void> check_free(const std::string& output, bool force);

}  // namespace panache::cli
