#include "learn/manifest.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "base/csv.h"

namespace panache {

Result<std::vector<ManifestRow>> read_manifest(const std::string& path, int set) {
  Result<CsvTable> table = read_csv(path, {"path", "style", "content", "take", "neutral", "split"});
  if (!table) return table.error();
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  std::vector<ManifestRow> rows;
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
    row.set = set;
    rows.push_back(std::move(row));
  }
  if (rows.empty()) return Error{path + ": lists no takes"};
  return rows;
}

Result<std::vector<StyleName>> read_style_names(const std::string& path) {
  Result<CsvTable> table = read_csv(path, {"name", "from", "description"});
  if (!table) return table.error();
  std::vector<StyleName> names;
  for (const CsvRow& cells : table->rows) {
    StyleName style{cells.values[0], {}, cells.values[2]};
    size_t begin = 0;
    const std::string& from = cells.values[1];
    while (begin < from.size()) {
      const size_t end = std::min(from.find(' ', begin), from.size());
      if (end > begin) style.from.push_back(from.substr(begin, end - begin));
      begin = end + 1;
    }
    names.push_back(std::move(style));
  }
  if (names.empty()) return Error{path + ": lists no styles"};
  return names;
}

std::vector<ManifestRow> rename_styles(const std::vector<StyleName>& names,
                                       std::vector<ManifestRow> rows) {
  std::map<std::string, std::string> renamed;
  for (const StyleName& style : names) {
    for (const std::string& from : style.from) renamed[from] = style.name;
  }
  std::vector<ManifestRow> kept;
  for (ManifestRow& row : rows) {
    if (!row.neutral) {
      const auto found = renamed.find(row.style);
      if (found == renamed.end()) continue;
      row.style = found->second;
    }
    kept.push_back(std::move(row));
  }
  return kept;
}

Result<void> apply_style_names(std::vector<StyleName>& names, std::vector<ManifestRow>& rows) {
  if (names.empty()) {
    std::set<std::string> seen;
    for (const ManifestRow& row : rows) {
      if (!row.neutral) seen.insert(row.style);
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
