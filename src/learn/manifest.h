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
  int set = 0;        // A performer of a manifest: styles are compared with their own neutral.
  std::string manifest = {};  // The file of the manifest,
  int line = 0;               // the line in it, for messages,
  std::string person = {};    // and the performer; "" where the manifest names none.
};

// The styles to learn, in the order of the model, and what the manifests call them.
struct StyleName {
  std::string name;               // "old"
  std::vector<std::string> from;  // Names in manifests, {"old"} or several; "PERSON/old" is the
                                  // style of this performer, and is not among "old" then.
  std::string description;
  std::string group = {};  // Its heading in lists, "moods"; "" without one.
};

// Reads a CSV with the columns path, style, content, take, neutral, split and, where it has it,
// person, in any order. The sets of its performers are numbered from `set` on, in their order in
// the file; a manifest without the column is one set.
Result<std::vector<ManifestRow>> read_manifest(const std::string& path, int set);

// The number that follows those of the sets of `rows`.
int next_set(const std::vector<ManifestRow>& rows);

// Reads a CSV with the columns name, from, description and, where it has it, group, in any order;
// several `from` are divided by spaces. Fails where a style cannot have a name, or is
// listed twice, or one `from` has two names, or a description or group is not one line of UTF-8.
Result<std::vector<StyleName>> read_style_names(const std::string& path);

// A sentence for each row whose file does not exist, with the manifest and line that name it.
std::vector<std::string> list_missing_files(const std::vector<ManifestRow>& rows);

// A sentence for each style of a manifest that `names` does not list, where it lists any.
std::vector<std::string> list_unnamed_styles(const std::vector<StyleName>& names,
                                             const std::vector<ManifestRow>& rows);

// Renames the styles of `rows`; rows of styles that `names` does not list are dropped.
std::vector<ManifestRow> rename_styles(const std::vector<StyleName>& names,
                                       std::vector<ManifestRow> rows);

// The same, and every style of `names` must have a take. With no names given, `names` becomes all
// styles of the rows, in order of the alphabet, called what they are; these names must be those
// that a style can have (check_style_name), as read_style_names() wants of its own.
Result<void> apply_style_names(std::vector<StyleName>& names, std::vector<ManifestRow>& rows);

}  // namespace panache
