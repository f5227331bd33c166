#pragma once
// The few pieces of HTML that a report is made of. What they make is well-formed XML as well.

#include <string>
#include <string_view>
#include <vector>

#include "eval/metrics.h"

namespace panache {

// <p>; `text` is escaped.
std::string html_paragraph(std::string_view text, std::string_view css_class = "");

// A drawing of base/svg.h as a part of the page, in a box of its own that scrolls where it is too
// narrow. `what` is for those who cannot see it. A `wide` one keeps its own size.
std::string html_drawing(const std::string& svg, std::string_view what, bool wide = false);

// What is shown once its `title` is asked for; `body` is HTML. Empty without a body.
std::string html_details(std::string_view title, const std::string& body);

struct HtmlCell {
  std::string text;             // Escaped by the table.
  bool best = false;            // In bold, with a dot before it.
  double share = kNotMeasured;  // 0 to 1: how long the bar behind the text is.
};

// A table with a name per row and numbers right of it, in a box that scrolls sideways.
class HtmlTable {
 public:
  explicit HtmlTable(std::string names) : names_(std::move(names)) {}

  // Columns under a common heading; without `group` there is none.
  void add_columns(const std::string& group, const std::vector<std::string>& labels);
  // One cell per column. A row that stands `apart` has a line above it: a mean, a reference.
  void add_row(const std::string& name, std::vector<HtmlCell> cells, bool apart = false);

  bool empty() const { return rows_.empty(); }
  // Empty without rows.
  std::string str(std::string_view caption = "") const;

 private:
  struct Column {
    std::string label;
    bool first = false;  // Of its group.
  };
  struct Group {
    std::string label;
    size_t columns = 0;
  };
  struct Row {
    std::string name;
    std::vector<HtmlCell> cells;
    bool apart = false;
  };
  std::string head() const;
  std::string body() const;

  std::string names_;
  std::vector<Column> columns_;
  std::vector<Group> groups_;
  std::vector<Row> rows_;
};

}  // namespace panache
