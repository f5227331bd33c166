#pragma once
// Tables of aligned columns for a terminal of 110 columns.

#include <string>
#include <vector>

namespace panache {

inline constexpr size_t kTextWidth = 110;

// `text`, or as much of it as fits into so many columns, ending in "...".
std::string cut_text(const std::string& text, size_t columns);

// Names on the left, numbers right-aligned in columns, which may stand in groups under a heading.
// Groups that do not fit beside each other follow below, with the names again.
class TextTable {
 public:
  explicit TextTable(std::string names) : names_(std::move(names)) {}

  // Labels are broken at their first space. Without `group` there is no heading, and every column
  // may be moved below by itself.
  void add_columns(const std::string& group, const std::vector<std::string>& labels);
  // One text per column.
  void add_row(const std::string& name, std::vector<std::string> cells);

  // No line is wider than kTextWidth: longer names and headings end in "...". Empty without rows.
  std::string str() const;

 private:
  struct Group {
    std::string label;
    size_t first = 0, end = 0;  // Columns.
  };
  struct Row {
    std::string name;
    std::vector<std::string> cells;
  };
  size_t column_width(size_t column) const;
  size_t group_width(const Group& group) const;
  // The groups, those wider than `width` in several.
  std::vector<Group> parts(size_t width) const;
  std::string block(const std::vector<Group>& groups, size_t name_width) const;

  std::string names_;
  std::vector<std::string> labels_;
  std::vector<Group> groups_;
  std::vector<Row> rows_;
};

}  // namespace panache
