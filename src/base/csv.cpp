#include "base/csv.h"

#include <algorithm>

#include "base/file.h"

namespace panache {
namespace {

// Splits the line at `at` and moves past it. Quoted cells may hold commas and doubled quotes.
std::vector<std::string> take_row(const std::string& text, size_t& at) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (; at < text.size(); ++at) {
    const char c = text[at];
    if (quoted) {
      if (c != '"') {
        cells.back() += c;
      } else if (at + 1 < text.size() && text[at + 1] == '"') {
        cells.back() += text[++at];
      } else {
        quoted = false;
      }
    } else if (c == '"') {
      quoted = true;
    } else if (c == ',') {
      cells.emplace_back();
    } else if (c == '\n') {
      ++at;
      break;
    } else if (c != '\r') {
      cells.back() += c;
    }
  }
  return cells;
}

}  // namespace

Result<CsvTable> read_csv(const std::string& path, const std::vector<std::string>& columns,
                          const std::vector<std::string>& optional) {
  Result<std::string> text = read_file(path);
  if (!text) return text.error();
  size_t at = text->starts_with("\xef\xbb\xbf") ? 3 : 0;
  CsvTable table;
  const std::vector<std::string> header = take_row(*text, at);
  if (const size_t other = header[0].find_first_of(";\t");
      header.size() == 1 && other != std::string::npos) {
    return Error{path + ":1: cells are separated by " +
                 (header[0][other] == ';' ? "semicolons" : "tabs") +
                 "; expected commas, and points in numbers: save the table as CSV with commas"};
  }
  table.columns = columns.empty() ? header : columns;
  std::vector<size_t> order;  // Indices of the cells; header.size() for a missing column.
  for (const std::string& column : table.columns) {
    const auto found = std::find(header.begin(), header.end(), column);
    if (found == header.end()) {
      return Error{path + ":1: column '" + column +
                   "' is missing; the first line must name the columns"};
    }
    order.push_back(found - header.begin());
  }
  for (const std::string& column : optional) {
    table.columns.push_back(column);
    order.push_back(std::find(header.begin(), header.end(), column) - header.begin());
  }
  int line = 1;
  for (size_t counted = 0; at < text->size();) {
    // A quoted cell may span several lines.
    for (; counted < at; ++counted) line += (*text)[counted] == '\n';
    const std::vector<std::string> cells = take_row(*text, at);
    if (cells.size() == 1 && cells[0].empty()) continue;
    if (cells.size() != header.size()) {
      return Error{path + ":" + std::to_string(line) + ": has " + std::to_string(cells.size()) +
                   " cells; expected " + std::to_string(header.size()) + " as in the first line"};
    }
    CsvRow row{line, {}};
    for (const size_t i : order) row.values.push_back(i < cells.size() ? cells[i] : "");
    table.rows.push_back(std::move(row));
  }
  return table;
}

}  // namespace panache
