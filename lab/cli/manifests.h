#pragma once
// Manifests on the command line, shared by train and eval.

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "base/result.h"
#include "takes/manifest.h"

namespace panache::cli {

struct ManifestOptions {
  std::vector<std::string> paths;
  std::string styles;  // CSV of style names, or empty.
  std::vector<std::string> unlabelled;
};
// Returns the positional option for the manifests.
CLI::Option* add_manifest_options(CLI::App& verb, ManifestOptions& options);

struct Manifests {
  std::vector<ManifestRow> rows;  // Styles renamed.
  std::vector<StyleName> styles;
  std::vector<ManifestRow> unlabelled;  // Motion without styles, for training.
  std::vector<std::string> left_out;    // A message for each unused style.
};
Result<Manifests> read_manifests(const ManifestOptions& options);

// The rows of both that are not marked test.
std::vector<ManifestRow> rows_to_train_on(const std::vector<ManifestRow>& rows,
                                          const std::vector<ManifestRow>& unlabelled);

// Fails with a message for each file of `rows` that does not exist.
Result<void> check_files(const std::vector<ManifestRow>& rows);

// Rejects an existing output, unless `force`.
Result<void> check_free(const std::string& output, bool force);

}  // namespace panache::cli
