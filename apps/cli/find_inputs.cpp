#include "find_inputs.h"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <utility>

#include "base/file.h"
#include "base/os/os.h"
#include "input.h"
#include "standard_streams.h"

namespace panache::cli {
namespace {

namespace fs = std::filesystem;

// Deeper than any user's folders, but safe for the stack.
constexpr size_t kDeepest = 256;

bool has_wildcard(const std::string& text) {
  return text.find_first_of("*?[") != std::string::npos;
}

// The entries of a folder sorted by name, without hidden ones.
Result<std::vector<fs::path>> entries_of(const fs::path& folder) {
  std::vector<fs::path> entries;
  std::error_code failure;
  const fs::path listed = folder.empty() ? fs::path(".") : folder;
  for (fs::directory_iterator at(listed, failure), end; !failure && at != end;
       at.increment(failure)) {
    const std::string name = at->path().filename().string();
    if (!name.starts_with('.')) entries.push_back(folder / name);
  }
  if (failure) return Error{listed.string() + ": cannot be read: " + failure.message()};
  std::sort(entries.begin(), entries.end());
  return entries;
}

// A link back to a parent folder would recurse for ever.
bool is_real_folder(const fs::path& path) {
  std::error_code status;
  return fs::is_directory(path, status) && !fs::is_symlink(path, status);
}

class Finder {
 public:
  explicit Finder(const std::string& output) {
    std::error_code status;
    if (fs::is_directory(output, status)) output_ = output;
  }

  // All motion files below `base`.
  Result<void> walk(const fs::path& base) {
    base_ = base;
    pattern_ = {"**", "*"};
    return match(base, 0, 0);
  }

  // All motion files whose paths match.
  Result<void> glob(const std::string& pattern) {
    base_.clear();
    pattern_.clear();
    for (const fs::path& part : fs::path(pattern)) {
      if (pattern_.empty() && !has_wildcard(part.string())) {
        base_ /= part;
      } else if (pattern_.empty() || part != "**" || pattern_.back() != "**") {
        pattern_.push_back(part.string());
      }
    }
    if (pattern_.back() == "**") pattern_.push_back("*");
    return match(base_, 0, 0);
  }

  void add(const fs::path& path, const fs::path& name) {
    ++matched;
    const fs::path normal = path.lexically_normal();
    if (!seen_.emplace(normal, name).second) return;
    found.files.push_back({path.string(), name.string()});
  }

  FoundFiles found;
  size_t matched = 0;  // Includes files that were found before.

 private:
  // Adds the files below `folder` that match the pattern from `part` on.
  Result<void> match(const fs::path& folder, size_t part, size_t depth) {
    if (depth > kDeepest) return Error{folder.string() + ": is nested too deeply for a batch"};
    // "**" matches no folder, or one folder and then "**" again.
    if (pattern_[part] == "**") {
      if (auto here = match(folder, part + 1, depth); !here) return here;
    }
    Result<std::vector<fs::path>> entries = entries_of(folder);
    if (!entries) return entries.error();
    for (const fs::path& entry : *entries) {
      if (auto good = match_entry(entry, part, depth); !good) return good;
    }
    return {};
  }

  Result<void> match_entry(const fs::path& entry, size_t part, size_t depth) {
    const bool is_folder = is_real_folder(entry);
    if (is_folder && is_output(entry)) return {};
    if (pattern_[part] == "**") {
      return is_folder ? match(entry, part, depth + 1) : Result<void>();
    }
    const std::string name = entry.filename().string();
    if (!fits_pattern(name, pattern_[part])) return {};
    if (part + 1 < pattern_.size()) {
      return is_folder ? match(entry, part + 1, depth + 1) : Result<void>();
    }
    std::error_code status;
    if (is_motion_extension(extension_of(name)) && fs::is_regular_file(entry, status)) {
      add(entry, base_.empty() ? entry : entry.lexically_relative(base_));
    }
    return {};
  }

  bool is_output(const fs::path& folder) const {
    std::error_code status;
    return output_ && fs::equivalent(folder, *output_, status);
  }

  std::optional<fs::path> output_;
  fs::path base_;                     // Before the first wildcard.
  std::vector<std::string> pattern_;  // The rest, one per folder level.
  std::set<std::pair<fs::path, fs::path>> seen_;
};

}  // namespace

Result<FoundFiles> find_inputs(const std::vector<std::string>& arguments,
                               const std::string& output) {
  Finder finder(output);
  for (const std::string& argument : arguments) {
    std::error_code status;
    const bool is_folder = fs::is_directory(argument, status);
    if (!is_folder && (!has_wildcard(argument) || fs::exists(argument, status))) {
      finder.add(argument, fs::path(argument).filename());
      continue;
    }
    finder.found.is_batch = true;
    finder.matched = 0;
    auto searched = is_folder ? finder.walk(argument) : finder.glob(argument);
    if (!searched) return searched.error();
    if (finder.matched == 0) {
      return Error{argument +
                   (is_folder ? ": holds no motion file, and neither do its folders"
                              : ": no motion file has a name that matches this") +
                   " (" + motion_extensions() + ")"};
    }
  }
  finder.found.is_batch |= finder.found.files.size() > 1;
  return finder.found;
}

Result<FoundFiles> list_inputs(const std::string& list, const std::string& below) {
  const bool is_stdin = list == kStandardStream;
  std::error_code status;
  if (!is_stdin && fs::is_directory(list, status)) {
    return Error{list + ": is a folder; expected a text file with a file's name in each line"};
  }
  const Result<std::string> text = read_file(is_stdin ? "/dev/stdin" : list);
  if (!text) return text.error();
  const fs::path base = fs::absolute(below.empty() ? "." : below).lexically_normal();
  Finder finder("");
  std::istringstream lines(*text);
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    if (line.ends_with('\r')) line.pop_back();
    if (line.empty()) continue;
    fs::path name = fs::path(line).filename();
    if (!below.empty()) {
      name = fs::absolute(line).lexically_normal().lexically_relative(base);
      if (name.empty() || *name.begin() == "..") {
        return Error{list + ":" + std::to_string(number) + ": " + line + " is not below " + below};
      }
    }
    finder.add(line, name);
  }
  if (finder.found.files.empty()) return Error{list + ": names no file"};
  finder.found.is_batch = true;
  return finder.found;
}

}  // namespace panache::cli
