#pragma once
// Whether a text is well-formed XML, as far as our drawings use XML.

#include <string>
#include <string_view>
#include <vector>

namespace panache {

// What is wrong with `text`; empty if nothing. Knows elements, attributes in double quotes,
// character data and the five named entities.
inline std::string xml_problem(std::string_view text) {
  const auto check_entities = [](std::string_view part) -> std::string {
    for (size_t at = part.find('&'); at != part.npos; at = part.find('&', at + 1)) {
      const std::string_view name = part.substr(at, part.find(';', at) - at);
      if (name != "&amp" && name != "&lt" && name != "&gt" && name != "&quot") {
        return "unknown entity " + std::string(name.substr(0, 20));
      }
    }
    for (const char c : part) {
      if (static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\t' && c != '\r') {
        return "control character";
      }
    }
    return "";
  };
  std::vector<std::string> open;
  size_t roots = 0;
  while (!text.empty()) {
    const size_t start = text.find('<');
    const std::string_view data = text.substr(0, start);
    if (const std::string problem = check_entities(data); !problem.empty()) return problem;
    if (open.empty() && data.find_first_not_of("\n") != data.npos) return "text outside";
    if (start == text.npos) break;
    text.remove_prefix(start + 1);
    const bool closing = text.starts_with('/');
    if (closing) text.remove_prefix(1);
    const size_t name_end = text.find_first_of(" />\n");
    if (name_end == text.npos) return "tag without end";
    const std::string name(text.substr(0, name_end));
    text.remove_prefix(name_end);
    std::vector<std::string> names;
    while (text.starts_with(' ')) {
      const size_t equals = text.find("=\"");
      if (equals == text.npos) return "attribute without value in " + name;
      const std::string key(text.substr(1, equals - 1));
      for (const std::string& other : names) {
        if (other == key) return "attribute " + key + " twice";
      }
      names.push_back(key);
      const size_t end = text.find('"', equals + 2);
      if (end == text.npos) return "value without end";
      const std::string_view value = text.substr(equals + 2, end - equals - 2);
      if (value.find('<') != value.npos) return "< in a value";
      if (const std::string problem = check_entities(value); !problem.empty()) return problem;
      text.remove_prefix(end + 1);
    }
    const bool empty = text.starts_with('/');
    if (empty) text.remove_prefix(1);
    if (!text.starts_with('>')) return "tag " + name + " does not end";
    text.remove_prefix(1);
    if (closing) {
      if (open.empty() || open.back() != name) return "closes " + name + " that is not open";
      open.pop_back();
    } else {
      if (open.empty() && ++roots > 1) return "two roots";
      if (!empty) open.push_back(name);
    }
  }
  return open.empty() ? (roots == 1 ? "" : "no root") : open.back() + " stays open";
}

// How often `part` occurs.
inline size_t occurrences(std::string_view text, std::string_view part) {
  size_t count = 0;
  for (size_t at = text.find(part); at != text.npos; at = text.find(part, at + 1)) ++count;
  return count;
}

}  // namespace panache
