#include "manifests.h"

#include <algorithm>
#include <filesystem>
#include <iterator>

#include "messages.h"

namespace panache::cli {

CLI::Option* add_manifest_options(CLI::App& verb, ManifestOptions& options) {
  CLI::Option* manifests =
      verb.add_option("manifests", options.paths,
                      "CSV files with the columns path, style, content, take, neutral, split "
                      "and, for several performers, person");
  verb.add_option("--styles", options.styles,
                  "CSV with the columns name, from, description: which styles of the manifests to "
                  "use, under which names");
  verb.add_option("--unlabelled", options.unlabelled,
                  "A manifest of motion without styles, of other people and actions, on which "
                  "training tries the styles too, so that they hold on any motion; may be given "
                  "several times")
      ->allow_extra_args(false);
  return manifests;
}

Result<Manifests> read_manifests(const ManifestOptions& options) {
  Manifests data;
  for (const std::string& path : options.paths) {
    Result<std::vector<ManifestRow>> rows = read_manifest(path, next_set(data.rows));
    if (!rows) return rows.error();
    data.rows.insert(data.rows.end(), rows->begin(), rows->end());
  }
  for (const std::string& path : options.unlabelled) {
    Result<std::vector<ManifestRow>> rows = read_manifest(path, 0);
    if (!rows) return rows.error();
    data.unlabelled.insert(data.unlabelled.end(), rows->begin(), rows->end());
  }
  if (!options.styles.empty()) {
    Result<std::vector<StyleName>> styles = read_style_names(options.styles);
    if (!styles) return styles.error();
    data.styles = *std::move(styles);
  }
  data.left_out = list_unnamed_styles(data.styles, data.rows);
  if (Result<void> named = apply_style_names(data.styles, data.rows); !named) return named.error();
  return data;
}

std::vector<ManifestRow> rows_to_train_on(const std::vector<ManifestRow>& rows,
                                          const std::vector<ManifestRow>& unlabelled) {
  std::vector<ManifestRow> trained_on;
  for (const auto* part : {&rows, &unlabelled}) {
    std::copy_if(part->begin(), part->end(), std::back_inserter(trained_on),
                 [](const ManifestRow& row) { return !row.test; });
  }
  return trained_on;
}

Result<void> check_files(const std::vector<ManifestRow>& rows) {
  const std::vector<std::string> missing = list_missing_files(rows);
  for (const std::string& line : missing) print_message(line);
  if (missing.empty()) return {};
  return Error{std::to_string(missing.size()) + " of " + plural(rows.size(), "take") + " " +
               (missing.size() == 1 ? "is" : "are") +
               " missing; expected paths that start at the folder of their manifest"};
}

Result<void> check_free(const std::string& output, bool force) {
  std::error_code status;
  if (!force && std::filesystem::exists(output, status)) {
    return Error{output + ": exists already; --force overwrites it"};
  }
  return {};
}

}  // namespace panache::cli
