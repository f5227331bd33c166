#include "eval/report_text_table.h"

#include <algorithm>
#include <cassert>

#include "base/text.h"

namespace panache {
namespace {

constexpr size_t kGap = 2;
constexpr size_t kMinNameWidth = 28, kWidestCell = 24;

std::string to_left(const std::string& text, size_t width) {
  const std::string shown = cut_text(text, width);
  return shown + std::string(width - character_count(shown), ' ');
}

std::string to_right(const std::string& text, size_t width) {
  const std::string shown = cut_text(text, width);
  return std::string(width - character_count(shown), ' ') + shown;
}

// A label's first word, and the rest.
std::pair<std::string, std::string> broken(const std::string& label) {
  const size_t space = label.find(' ');
  if (space == label.npos) return {"", label};
  return {label.substr(0, space), label.substr(space + 1)};
}

void add_line(std::string& text, std::string line) {
  line.erase(line.find_last_not_of(' ') + 1);
  text += line + "\n";
}

}  // namespace

std::string cut_text(const std::string& text, size_t columns) {
  if (character_count(text) <= columns) return text;
  const std::string kEnd = columns > 3 ? "..." : "";
  std::string out;
  size_t used = 0;
  for (size_t at = 0; at < text.size(); ++at) {
    const bool starts = (static_cast<unsigned char>(text[at]) & 0xc0) != 0x80;
    if (starts && used++ == columns - kEnd.size()) break;
    out += text[at];
  }
  return out + kEnd;
}

void TextTable::add_columns(const std::string& group, const std::vector<std::string>& labels) {
  const size_t first = labels_.size();
  labels_.insert(labels_.end(), labels.begin(), labels.end());
  if (!group.empty() && !labels.empty()) groups_.push_back({group, first, labels_.size()});
  for (size_t c = first; group.empty() && c < labels_.size(); ++c)
    groups_.push_back({"", c, c + 1});
}

void TextTable::add_row(const std::string& name, std::vector<std::string> cells) {
  assert(cells.size() == labels_.size());
  rows_.push_back({name, std::move(cells)});
}

size_t TextTable::column_width(size_t column) const {
  const auto [above, below] = broken(labels_[column]);
  size_t width = std::max(character_count(above), character_count(below));
  for (const Row& row : rows_) width = std::max(width, character_count(row.cells[column]));
  return std::min(width, kWidestCell);
}

size_t TextTable::group_width(const Group& group) const {
  size_t width = 0;
  for (size_t c = group.first; c < group.end; ++c) width += kGap + column_width(c);
  return width;
}

std::vector<TextTable::Group> TextTable::parts(size_t width) const {
  std::vector<Group> parts;
  for (const Group& group : groups_) {
    parts.push_back({group.label, group.first, group.first});
    for (size_t c = group.first; c < group.end; ++c) {
      Group longer = parts.back();
      longer.end = c + 1;
      if (parts.back().first < c && group_width(longer) > width) {
        parts.push_back({group.label, c, c + 1});
      } else {
        parts.back() = longer;
      }
    }
  }
  return parts;
}

std::string TextTable::block(const std::vector<Group>& groups, size_t name_width) const {
  std::string headings(name_width, ' '), above(name_width, ' ');
  std::string below = to_left(names_, name_width);
  bool grouped = false, two_lines = false;
  for (const Group& group : groups) {
    const size_t width = group_width(group);
    grouped |= !group.label.empty();
    headings += std::string(kGap, ' ') + to_left(group.label, width - kGap);
    for (size_t c = group.first; c < group.end; ++c) {
      const auto [first, rest] = broken(labels_[c]);
      two_lines |= !first.empty();
      above += std::string(kGap, ' ') + to_right(first, column_width(c));
      below += std::string(kGap, ' ') + to_right(rest, column_width(c));
    }
  }
  std::string text;
  if (grouped) add_line(text, headings);
  if (two_lines) add_line(text, above);
  add_line(text, below);
  for (const Row& row : rows_) {
    std::string line = to_left(row.name, name_width);
    for (const Group& group : groups) {
      for (size_t c = group.first; c < group.end; ++c) {
        line += std::string(kGap, ' ') + to_right(row.cells[c], column_width(c));
      }
    }
    add_line(text, line);
  }
  return text;
}

std::string TextTable::str() const {
  if (rows_.empty()) return "";
  size_t name_width = character_count(names_);
  for (const Row& row : rows_) name_width = std::max(name_width, character_count(row.name));
  size_t columns_width = 0;
  for (const Group& group : groups_) columns_width += group_width(group);
  // Names get the width that columns leave.
  const size_t left = kTextWidth - std::min(columns_width, kTextWidth);
  name_width = std::min(name_width, std::max(left, kMinNameWidth));
  std::string text;
  std::vector<Group> beside;
  size_t used = name_width;
  for (const Group& group : parts(kTextWidth - name_width)) {
    if (!beside.empty() && used + group_width(group) > kTextWidth) {
      text += block(beside, name_width) + "\n";
      beside.clear();
      used = name_width;
    }
    beside.push_back(group);
    used += group_width(group);
  }
  return text + block(beside, name_width);
}

}  // namespace panache
