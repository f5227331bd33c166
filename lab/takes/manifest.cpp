#include "takes/manifest.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <utility>

#include "base/csv.h"
#include "learn/style_file.h"
#include "style/model/model.h"

namespace panache {

namespace {

// "takes.csv:12: ", or empty.
std::string where(const ManifestRow& row) {
  return row.manifest.empty() ? "" : row.manifest + ":" + std::to_string(row.line) + ": ";
}

// The entry in `names` for a row's style; null if there is none.
const StyleName* find_style_name(const std::vector<StyleName>& names, const ManifestRow& row) {
  const auto find = [&](const std::string& from) -> const StyleName* {
    for (const StyleName& style : names) {
      if (std::find(style.from.begin(), style.from.end(), from) != style.from.end()) return &style;
    }
    return nullptr;
  };
  const StyleName* own = row.person.empty() ? nullptr : find(row.person + "/" + row.style);
  return own ? own : find(row.style);
}

}  // namespace

Result<std::vector<ManifestRow>> read_manifest(const std::string& path, int set) {
  Result<CsvTable> table =
      read_csv(path, {"path", "style", "content", "take", "neutral", "split"}, {"person"});
  if (!table) return table.error();
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  std::vector<ManifestRow> rows;
  std::map<std::string, int> sets;  // The set of each performer.
  for (const CsvRow& cells : table->rows) {
    ManifestRow row;
    row.path = (folder / cells.values[0]).string();
    row.content = cells.values[2];
    row.take = cells.values[3];
    const std::string& neutral = cells.values[4];
    const std::string& split = cells.values[5];
    const std::string where = path + ":" + std::to_string(cells.line);
    if (neutral != "0" && neutral != "1") {
      return Error{where + ": column neutral is '" + neutral + "'; expected 0 or 1"};
    }
    if (split != "train" && split != "test") {
      return Error{where + ": column split is '" + split + "'; expected train or test"};
    }
    row.neutral = neutral == "1";
    row.style = row.neutral ? "neutral" : cells.values[1];
    row.test = split == "test";
    row.person = cells.values[6];
    row.set = sets.try_emplace(row.person, set + static_cast<int>(sets.size())).first->second;
    row.manifest = path;
    row.line = cells.line;
    rows.push_back(std::move(row));
  }
  if (rows.empty()) return Error{path + ": lists no takes"};
  return rows;
}

int next_set(const std::vector<ManifestRow>& rows) {
  int next = 0;
  for (const ManifestRow& row : rows) next = std::max(next, row.set + 1);
  return next;
}

Result<std::vector<StyleName>> read_style_names(const std::string& path) {
  Result<CsvTable> table =
      read_csv(path, {"name", "from", "description"}, {"group", "words", "side"});
  if (!table) return table.error();
  std::vector<StyleName> names;
  std::set<std::string> known, taken;
  for (const CsvRow& cells : table->rows) {
    StyleName style{cells.values[0], {}, cells.values[2], cells.values[3], cells.values[4],
                    cells.values[5]};
    const std::string where = path + ":" + std::to_string(cells.line) + ": ";
    if (auto good = check_style_name(style.name); !good) return Error{where + good.error().message};
    if (!known.insert(style.name).second) {
      return Error{where + "style '" + style.name +
                   "' is listed already; expected one line with all its names in column from"};
    }
    for (const size_t column : {2, 3, 4, 5}) {  // A model stores each on a line of its metadata.
      if (is_one_line(cells.values[column])) continue;
      return Error{where + "column " + table->columns[column] +
                   " is not one line of UTF-8 text; expected no line breaks and no tabs in it"};
    }
    if (auto good = check_side_phrase(style.side); !good) {
      return Error{where + "column side: " + good.error().message};
    }
    size_t begin = 0;
    const std::string& from = cells.values[1];
    while (begin < from.size()) {
      const size_t end = std::min(from.find(' ', begin), from.size());
      if (end > begin) style.from.push_back(from.substr(begin, end - begin));
      if (end > begin && !taken.insert(style.from.back()).second) {
        return Error{where + "'" + style.from.back() +
                     "' is in column from already; expected it for one style"};
      }
      begin = end + 1;
    }
    names.push_back(std::move(style));
  }
  if (names.empty()) return Error{path + ": lists no styles"};
  return names;
}

std::vector<std::string> list_missing_files(const std::vector<ManifestRow>& rows) {
  std::vector<std::string> lines;
  for (const ManifestRow& row : rows) {
    std::error_code status;
    if (std::filesystem::exists(row.path, status)) continue;
    lines.push_back(where(row) + row.path + ": there is no such file");
  }
  return lines;
}

std::vector<std::string> list_unnamed_styles(const std::vector<StyleName>& names,
                                             const std::vector<ManifestRow>& rows) {
  if (names.empty()) return {};
  std::map<std::pair<std::string, std::string>, int> dropped;  // Takes by performer and style.
  for (const ManifestRow& row : rows) {
    if (row.neutral || find_style_name(names, row)) continue;
    ++dropped[{row.manifest + (row.person.empty() ? "" : ": performer '" + row.person + "'"),
               row.style}];
  }
  std::vector<std::string> lines;
  for (const auto& [style, takes] : dropped) {
    lines.push_back(style.first + ": style '" + style.second +
                    "' is left out: it is not among the styles to learn (" + std::to_string(takes) +
                    (takes == 1 ? " take)" : " takes)"));
  }
  return lines;
}

std::vector<ManifestRow> rename_styles(const std::vector<StyleName>& names,
                                       std::vector<ManifestRow> rows) {
  std::vector<ManifestRow> kept;
  for (ManifestRow& row : rows) {
    if (!row.neutral) {
      const StyleName* style = find_style_name(names, row);
      if (!style) continue;
      row.style = style->name;
    }
    kept.push_back(std::move(row));
  }
  return kept;
}

Result<void> apply_style_names(std::vector<StyleName>& names, std::vector<ManifestRow>& rows) {
  if (names.empty()) {
    std::set<std::string> seen;
    for (const ManifestRow& row : rows) {
      if (row.neutral || !seen.insert(row.style).second) continue;
      if (auto good = check_style_name(row.style); !good) {
        return Error{where(row) + good.error().message + "; give it another name",
                     ErrorKind::bad_style_name};
      }
    }
    for (const std::string& style : seen) names.push_back({style, {style}, ""});
  }
  rows = rename_styles(names, std::move(rows));
  for (const StyleName& style : names) {
    const bool used = std::any_of(rows.begin(), rows.end(),
                                  [&](const ManifestRow& r) { return r.style == style.name; });
    if (!used) return Error{"style '" + style.name + "' has no take in any manifest"};
  }
  return {};
}

}  // namespace panache
