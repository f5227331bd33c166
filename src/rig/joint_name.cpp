#include "rig/joint_name.h"

#include <algorithm>
#include <array>

namespace panache {
namespace {

// Bytes above 127 belong to letters of other scripts. The C library's tests depend on the locale.
bool is_upper(char c) { return c >= 'A' && c <= 'Z'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_lower(char c) { return (c >= 'a' && c <= 'z') || static_cast<unsigned char>(c) > 127; }
bool is_word(char c) { return is_upper(c) || is_lower(c) || is_digit(c); }

// Whether a new word begins at name[i], i > 0, both neighbours being letters or digits.
bool begins_word(std::string_view name, size_t i) {
  const char before = name[i - 1], here = name[i];
  if (is_digit(before) != is_digit(here)) return true;
  if (!is_upper(here)) return false;
  if (is_lower(before)) return true;
  // The last capital of a row begins the next word: "LHip" is "L", "Hip".
  return i + 1 < name.size() && is_lower(name[i + 1]);
}

std::vector<std::string> split(std::string_view name) {
  std::vector<std::string> words;
  bool inside = false;
  for (size_t i = 0; i < name.size(); ++i) {
    if (!is_word(name[i])) {
      inside = false;
      continue;
    }
    if (!inside || begins_word(name, i)) words.emplace_back();
    inside = true;
    words.back() += is_upper(name[i]) ? static_cast<char>(name[i] - 'A' + 'a') : name[i];
  }
  return words;
}

Side side_of(std::string_view word) {
  constexpr std::array<std::string_view, 9> kLeft = {
      "left", "l", "lf", "lft", "izq", "links", "gauche", "izquierda", "sinistra"};
  constexpr std::array<std::string_view, 9> kRight = {"right",  "r",      "rt",      "rgt",   "der",
                                                      "rechts", "droite", "derecha", "destra"};
  if (std::find(kLeft.begin(), kLeft.end(), word) != kLeft.end()) return Side::left;
  if (std::find(kRight.begin(), kRight.end(), word) != kRight.end()) return Side::right;
  return Side::none;
}

// Japanese names begin with their side.
Side take_first_letter(std::string& word) {
  for (const auto& [letter, side] : {std::pair<std::string_view, Side>{"左", Side::left},
                                     std::pair<std::string_view, Side>{"右", Side::right}}) {
    if (!word.starts_with(letter)) continue;
    word.erase(0, letter.size());
    return side;
  }
  return Side::none;
}

// "lhand", "handleft": a side without separator counts only next to a word that the mapping uses,
// or every "leg" would be a left "eg".
Side split_run_on(std::string& word) {
  constexpr std::string_view kWords[] = {"hand", "wrist",   "foot", "ankle",   "toe",
                                         "toes", "toebase", "ball", "forearm", "elbow"};
  for (std::string_view side : {"left", "right", "l", "r"}) {
    for (std::string_view known : kWords) {
      if (word.size() != side.size() + known.size()) continue;
      const bool before = word.starts_with(side) && word.ends_with(known);
      const bool after = word.starts_with(known) && word.ends_with(side);
      if (!before && !after) continue;
      word = known;
      return side_of(side);
    }
  }
  return Side::none;
}

}  // namespace

bool JointName::has(std::string_view word) const {
  return std::find(words.begin(), words.end(), word) != words.end();
}

JointName parse_joint_name(std::string_view name) {
  constexpr size_t kLongest = 100;  // Letters: of a longer name, which no tool makes, the last.
  if (name.size() > kLongest) name.remove_prefix(name.size() - kLongest);
  const size_t space = name.find_last_of(":|");
  if (space != std::string_view::npos) name.remove_prefix(space + 1);
  JointName out;
  bool left = false, right = false;
  for (std::string& word : split(name)) {
    Side side = side_of(word);
    const bool is_side = side != Side::none;
    if (!is_side) side = take_first_letter(word);
    if (side == Side::none) side = split_run_on(word);
    left |= side == Side::left;
    right |= side == Side::right;
    if (!is_side) out.words.push_back(std::move(word));
  }
  // A name with both sides counts as central.
  if (left != right) out.side = left ? Side::left : Side::right;
  return out;
}

std::vector<std::string> without_number(const std::vector<std::string>& words) {
  std::vector<std::string> out = words;
  if (out.size() > 1 && is_digit(out.back().front())) out.pop_back();
  return out;
}

}  // namespace panache
