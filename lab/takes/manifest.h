#pragma once
// Manifests: tables of files with their style and action.

#include <string>
#include <vector>

#include "base/result.h"
#include "learn/take.h"

namespace panache {

// A style to learn, and its names in manifests. Lists have the order of the model.
struct StyleName {
  std::string name;               // "old"
  std::vector<std::string> from;  // Names in manifests, {"old"} or several; "PERSON/old" is the
                                  // style of this performer, and is not among "old" then.
  std::string description;
  std::string group = {};  // Its heading in lists, "moods"; "" without one.
  std::string words = {};  // Other words for it, separated by spaces; may be empty.
  std::string side = {};   // What its takes show: "right leg" (style/model/side.h); may be empty.
};

// Reads a CSV with the columns path, style, content, take, neutral, split and optionally person, in
// any order. The sets of its performers are numbered from `set`, in file order; a manifest without
// the column is one set.
Result<std::vector<ManifestRow>> read_manifest(const std::string& path, int set);

// One more than the largest set of `rows`.
int next_set(const std::vector<ManifestRow>& rows);

// Reads a CSV with the columns name, from, description and optionally group, words and side, in any
// order; several `from` are separated by spaces. Fails if a style name is invalid or listed twice,
// if one `from` has two names, or if a description, group, words or side are not one line of UTF-8.
Result<std::vector<StyleName>> read_style_names(const std::string& path);

// A sentence for each row whose file does not exist, with its manifest and line.
std::vector<std::string> list_missing_files(const std::vector<ManifestRow>& rows);

// A sentence for each style of a manifest that `names` does not list, unless `names` is empty.
std::vector<std::string> list_unnamed_styles(const std::vector<StyleName>& names,
                                             const std::vector<ManifestRow>& rows);

// Renames the styles of `rows`; drops rows whose style `names` does not list.
std::vector<ManifestRow> rename_styles(const std::vector<StyleName>& names,
                                       std::vector<ManifestRow> rows);

// The same, and every style of `names` must have a take. If `names` is empty, it becomes all styles
// of the rows in alphabetical order; their names must be valid (check_style_name), as those for
// read_style_names().
Result<void> apply_style_names(std::vector<StyleName>& names, std::vector<ManifestRow>& rows);

}  // namespace panache
