#pragma once
// Aligned tables for a terminal of 110 columns.

#include <string>
#include <vector>

namespace panache {

inline constexpr size_t kTextWidth = 110;

// `text`, cut to this many columns and then ending in "...".
std::string cut_text(const std::string& text, size_t columns);

// Names on the left, and right-aligned columns, optionally grouped under headings. Groups that do
// not fit next to each other follow below, with the names repeated.
class TextTable {
 public:
  explicit TextTable(std::string names) : names_(std::move(names)) {}

  // Labels are broken at their first space. Without `group` there is no heading, and each column
  // may wrap on its own.
  void add_columns(const std::string& group, const std::vector<std::string>& labels);
  // One text per column.
  void add_row(const std::string& name, std::vector<std::string> cells);

  // Lines are at most kTextWidth wide: longer names and headings end in "...". Empty without rows.
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
  // The groups, with those wider than `width` split.
  std::vector<Group> parts(size_t width) const;
  std::string block(const std::vector<Group>& groups, size_t name_width) const;

  std::string names_;
  std::vector<std::string> labels_;
  std::vector<Group> groups_;
  std::vector<Row> rows_;
};

}  // namespace panache
