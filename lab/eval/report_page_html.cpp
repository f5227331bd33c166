#include "eval/report_page_html.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "base/xml.h"
#include "eval/report_numbers.h"

namespace panache {
namespace {

constexpr size_t kLongName = 36;  // Characters; longer ones are broken into lines.

std::string class_attribute(const std::string& names) {
  return names.empty() ? "" : " class=\"" + names + "\"";
}

std::string cell_html(const HtmlCell& cell, bool first) {
  std::string classes = first ? "first" : "", style;
  if (std::isfinite(cell.share)) {
    classes += classes.empty() ? "share" : " share";
    style = " style=\"--share:" + number_text(100 * std::clamp(cell.share, 0.0, 1.0), 1) + "%\"";
  }
  const std::string text = xml_escaped(cell.text);
  return "<td" + class_attribute(classes) + style + ">" +
         (cell.best ? "<b>\xe2\x80\xa2 " + text + "</b>" : text) + "</td>";
}

}  // namespace

std::string html_paragraph(std::string_view text, std::string_view css_class) {
  return "<p" + class_attribute(std::string(css_class)) + ">" + xml_escaped(text) + "</p>\n";
}

std::string html_drawing(const std::string& svg, std::string_view what, bool wide) {
  constexpr std::string_view kStart = "<svg";
  assert(svg.starts_with(kStart));
  return "<figure class=\"" + std::string(wide ? "wide" : "plot") + "\">" + std::string(kStart) +
         " role=\"img\" aria-label=\"" + xml_escaped(what) + "\"" + svg.substr(kStart.size()) +
         "</figure>\n";
}

std::string html_details(std::string_view title, const std::string& body) {
  if (body.empty()) return "";
  return "<details><summary>" + xml_escaped(title) + "</summary>\n" + body + "</details>\n";
}

void HtmlTable::add_columns(const std::string& group, const std::vector<std::string>& labels) {
  if (labels.empty()) return;
  groups_.push_back({group, labels.size()});
  for (size_t i = 0; i < labels.size(); ++i) columns_.push_back({labels[i], i == 0});
}

void HtmlTable::add_row(const std::string& name, std::vector<HtmlCell> cells, bool apart) {
  assert(cells.size() == columns_.size());
  rows_.push_back({name, std::move(cells), apart});
}

std::string HtmlTable::head() const {
  const bool grouped = std::any_of(groups_.begin(), groups_.end(),
                                   [](const Group& group) { return !group.label.empty(); });
  std::string out = "<thead>\n<tr><th scope=\"col\"" +
                    std::string(grouped ? " rowspan=\"2\"" : "") + ">" + xml_escaped(names_) +
                    "</th>";
  if (grouped) {
    for (const Group& group : groups_) {
      out += "<th scope=\"colgroup\" class=\"group first\" colspan=\"" +
             std::to_string(group.columns) + "\">" + xml_escaped(group.label) + "</th>";
    }
    out += "</tr>\n<tr>";
  }
  for (const Column& column : columns_) {
    out += "<th scope=\"col\"" + class_attribute(column.first ? "first" : "") + ">" +
           xml_escaped(column.label) + "</th>";
  }
  return out + "</tr>\n</thead>\n";
}

std::string HtmlTable::body() const {
  std::string out = "<tbody>\n";
  for (const Row& row : rows_) {
    out += "<tr" + class_attribute(row.apart ? "apart" : "") + "><th scope=\"row\"" +
           class_attribute(column_count(row.name) > kLongName ? "long" : "") + ">" +
           xml_escaped(row.name) + "</th>";
    for (size_t c = 0; c < row.cells.size(); ++c) {
      out += cell_html(row.cells[c], columns_[c].first);
    }
    out += "</tr>\n";
  }
  return out + "</tbody>\n";
}

std::string HtmlTable::str(std::string_view caption) const {
  if (empty()) return "";
  std::string out = "<div class=\"table\"><table>\n";
  if (!caption.empty()) out += "<caption>" + xml_escaped(caption) + "</caption>\n";
  return out + head() + body() + "</table></div>\n";
}

}  // namespace panache
