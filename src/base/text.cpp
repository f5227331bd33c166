#include "base/text.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

namespace panache {

size_t utf8_length(std::string_view text) noexcept {
  const auto byte = [&](size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char lead = byte(0);
  const size_t length = lead < 0x80 ? 1 : lead < 0xc2 ? 0 : lead < 0xe0 ? 2 : lead < 0xf0 ? 3 : 4;
  if (length == 0 || lead > 0xf4 || length > text.size()) return 0;
  for (size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xc0) != 0x80) return 0;
  }
  if (lead == 0xe0 && byte(1) < 0xa0) return 0;
  if (lead == 0xed && byte(1) > 0x9f) return 0;
  if (lead == 0xf0 && byte(1) < 0x90) return 0;
  if (lead == 0xf4 && byte(1) > 0x8f) return 0;
  return length;
}

size_t character_count(std::string_view text) noexcept {
  return static_cast<size_t>(std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xc0) != 0x80;
  }));
}

std::string plural(uint64_t count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

std::string to_utf8(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const size_t length = utf8_length(text);
    out += length > 0 ? text.substr(0, length) : kReplacementCharacter;
    text.remove_prefix(length > 0 ? length : 1);
  }
  return out;
}

namespace {

// U+FFFE and U+FFFF, which XML does not allow.
bool is_no_xml(std::string_view character) {
  return character == "\xef\xbf\xbe" || character == "\xef\xbf\xbf";
}

}  // namespace

std::string xml_escaped(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const size_t length = utf8_length(text);
    const std::string_view character = text.substr(0, std::max<size_t>(length, 1));
    text.remove_prefix(character.size());
    const unsigned char c = character[0];
    if (length == 0 || (c < 0x20 && c != '\t' && c != '\n' && c != '\r') || c == 0x7f ||
        is_no_xml(character)) {
      out += kReplacementCharacter;
    } else if (c == '&') {
      out += "&amp;";
    } else if (c == '<') {
      out += "&lt;";
    } else if (c == '>') {
      out += "&gt;";
    } else if (c == '"') {
      out += "&quot;";
    } else {
      out += character;
    }
  }
  return out;
}

namespace {

// Names in files can have any length; letters beyond this are not compared.
constexpr size_t kCompared = 64;

std::string folded(std::string_view name) {
  return lower_case(std::string(name.substr(0, kCompared)));
}

// The minimum number of letters to add, drop, replace or swap with a neighbour.
size_t edit_distance(std::string_view a, std::string_view b) {
  std::array<std::vector<size_t>, 3> rows;  // Two letters of `a` back, one back, and this one.
  rows.fill(std::vector<size_t>(b.size() + 1));
  std::iota(rows[1].begin(), rows[1].end(), size_t{0});
  for (size_t i = 1; i <= a.size(); ++i) {
    rows[2][0] = i;
    for (size_t j = 1; j <= b.size(); ++j) {
      const size_t replaced = rows[1][j - 1] + (a[i - 1] != b[j - 1]);
      rows[2][j] = std::min({rows[1][j] + 1, rows[2][j - 1] + 1, replaced});
      const bool exchanged = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (exchanged) rows[2][j] = std::min(rows[2][j], rows[0][j - 2] + 1);
    }
    std::rotate(rows.begin(), rows.begin() + 1, rows.end());
  }
  return rows[1].back();
}

}  // namespace

std::vector<std::string> nearest_names(std::string_view wanted,
                                       const std::vector<std::string>& names, size_t count) {
  const std::string typed = folded(wanted);
  std::vector<std::pair<size_t, std::string>> found;
  for (const std::string& name : names) {
    const std::string known = folded(name);
    const size_t distance = edit_distance(typed, known);
    const bool begins = typed.size() > 1 && known.size() > 1 &&
                        (known.starts_with(typed) || typed.starts_with(known));
    const size_t allowed = std::max<size_t>(1, std::max(typed.size(), known.size()) / 3);
    if ((distance <= allowed && distance < known.size()) || begins) {
      found.emplace_back(distance, name);
    }
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  found.resize(std::min(found.size(), count));
  std::vector<std::string> nearest;
  nearest.reserve(found.size());
  for (auto& [distance, name] : found) nearest.push_back(std::move(name));
  return nearest;
}

std::string is_or_are(const std::vector<std::string>& names) {
  return (names.size() > 1 ? "are " : "is ") + one_of(names, " and ");
}

}  // namespace panache
