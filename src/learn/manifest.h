#pragma once
// Manifests: which files hold which style of which action.

#include <string>
#include <vector>

#include "base/result.h"

namespace panache {

struct ManifestRow {
  std::string path;     // As found on disk: relative paths start at the manifest's folder.
  std::string style;    // After renaming; the neutral style is "neutral" whatever it was called.
  std::string content;  // "walk", "raise-left-hand", ...
  std::string take;
  bool neutral = false;
  bool test = false;  // Held out: no model may be trained on it.
  int set = 0;        // Which manifest it came from: styles are compared with their own neutral.
};

// The styles to learn, in the order of the model, and what the manifests call them.
struct StyleName {
  std::string name;               // "old"
  std::vector<std::string> from;  // Names in manifests, {"old"} or several.
  std::string description;
};

// Reads a CSV with the columns path, style, content, take, neutral, split, in any order. `set`
// marks its rows.
Result<std::vector<ManifestRow>> read_manifest(const std::string& path, int set);

// Reads a CSV with the columns name, from, description; several `from` are divided by spaces.
Result<std::vector<StyleName>> read_style_names(const std::string& path);

// Renames the styles of `rows`; rows of styles that `names` does not list are dropped.
std::vector<ManifestRow> rename_styles(const std::vector<StyleName>& names,
                                       std::vector<ManifestRow> rows);

// The same, and every style of `names` must have a take. With no
// names given, `names` becomes all styles of the rows, in order of the alphabet, called what they
// are.
Result<void> apply_style_names(std::vector<StyleName>& names, std::vector<ManifestRow>& rows);

}  // namespace panache
