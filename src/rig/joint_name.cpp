#include "rig/joint_name.h"

#include <algorithm>
#include <array>
#include <initializer_list>
#include <iterator>
#include <string_view>

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

bool has_any(const JointName& name, std::initializer_list<std::string_view> words) {
  return std::any_of(words.begin(), words.end(), [&](auto word) { return name.has(word); });
}

std::vector<std::string> without_number(const std::vector<std::string>& words) {
  std::vector<std::string> out = words;
  if (out.size() > 1 && is_digit(out.back().front())) out.pop_back();
  return out;
}

namespace {

bool has_both(const JointName& name, std::string_view a, std::string_view b) {
  return name.has(a) && name.has(b);
}

// The Japanese words are those of MikuMikuDance: wrist, ankle, toe, head, neck, elbow, knee, twist.
constexpr std::string_view kNear[] = {
    "thumb",   "index",  "middle",  "mid",      "ring",       "pinky",  "little",     "finger",
    "fingers", "carpal", "meta",    "end",      "nub",        "tip",    "top",        "site",
    "ik",      "target", "pole",    "effector", "metacarpal", "heel",   "weapon",     "prop",
    "ctrl",    "ctl",    "control", "mch",      "tweak",      "helper", "attach",     "socket",
    "inner",   "outer",  "bck",     "fwd",      "mesh",       "geo",    "corrective", "goal",
    "offset",  "pivot",  "grip",    "palm",     "share",      "vis",    "holder",     "mount"};

using enum HumanJoint;

struct Standard {
  std::string_view name;  // Words in lower case, one after the other, without the side.
  HumanJoint joint;       // Of the left side.
};
constexpr Standard kStandards[] = {
    {"hips", hips},
    {"pelvis", hips},
    {"spine", spine},
    {"chest", chest},
    {"neck", neck},
    {"head", head},
    {"shoulder", left_shoulder},
    {"clavicle", left_shoulder},
    {"collar", left_shoulder},
    {"upperarm", left_upper_arm},
    {"arm", left_upper_arm},
    {"lowerarm", left_lower_arm},
    {"forearm", left_lower_arm},
    {"hand", left_hand},
    {"upperleg", left_upper_leg},
    {"thigh", left_upper_leg},
    {"upleg", left_upper_leg},
    {"lowerleg", left_lower_leg},
    {"calf", left_lower_leg},
    {"shin", left_lower_leg},
    {"leg", left_lower_leg},
    {"foot", left_foot},
    {"toes", left_toes},
    {"toebase", left_toes},
    {"toe", left_toes},
    {"ball", left_toes},
};

bool is_number(const std::string& word) { return word.front() >= '0' && word.front() <= '9'; }

// The meaningful words, joined: without "def", "bip 01", "cc base", and without a trailing number
// if `numbered`.
std::string plain(const JointName& name, bool numbered) {
  constexpr std::string_view kPrefixes[] = {"def", "bind", "bnd", "jnt",  "joint", "bone",
                                            "bip", "j",    "cc",  "base", "c",     "skin"};
  std::vector<std::string> words = name.words;
  while (!words.empty() && std::find(std::begin(kPrefixes), std::end(kPrefixes), words.front()) !=
                               std::end(kPrefixes)) {
    words.erase(words.begin());
    if (words.size() > 1 && is_number(words.front())) words.erase(words.begin());
  }
  while (words.size() > 1 && (words.back() == "jnt" || words.back() == "joint" ||
                              words.back() == "bone" || (numbered && is_number(words.back())))) {
    words.pop_back();
  }
  std::string text;
  for (const std::string& word : words) text += word;
  return text;
}

}  // namespace

bool is_hand(const JointName& name) { return has_any(name, {"hand", "wrist", "手首"}); }
bool is_toe(const JointName& name) {
  return has_any(name, {"toe", "toes", "toebase", "ball", "forefoot", "つま先"}) ||
         has_both(name, "fore", "foot");
}
bool is_ankle(const JointName& name) { return has_any(name, {"ankle", "足首"}); }
bool is_foot(const JointName& name) {
  return (name.has("foot") || is_ankle(name)) && !is_toe(name);
}
bool is_head(const JointName& name) { return has_any(name, {"head", "skull", "頭"}); }
bool is_neck(const JointName& name) { return has_any(name, {"neck", "首"}); }
bool is_pelvis(const JointName& name) { return has_any(name, {"pelvis", "hips", "hip"}); }
bool is_spine(const JointName& name) {
  return has_any(name, {"spine", "torso", "abdomen", "waist", "chest"});
}
bool is_forearm(const JointName& name) {
  return has_any(name, {"forearm", "lowerarm", "elbow", "radius", "ulna", "ひじ"}) ||
         has_both(name, "fore", "arm") || has_both(name, "lower", "arm") ||
         has_both(name, "lo", "arm");
}
bool is_shin(const JointName& name) {
  return has_any(name, {"shin", "calf", "knee", "tibia", "lowerleg", "ひざ"}) ||
         has_both(name, "lower", "leg") || has_both(name, "lo", "leg");
}
bool is_twist(const JointName& name) {
  return has_any(name, {"twist", "roll", "part", "捩", "corrective", "bicep", "helper"});
}

bool is_near(const JointName& name) {
  return std::any_of(std::begin(kNear), std::end(kNear),
                     [&](std::string_view word) { return name.has(word); });
}

bool is_on_head(const JointName& name) {
  return has_any(name, {"jaw",  "eye",   "eyes",  "nose", "tongue", "teeth", "lip",
                        "lips", "brow",  "brows", "ear",  "ears",   "hair",  "chin",
                        "face", "cheek", "mouth", "hat",  "helmet", "cap",   "beard"});
}

size_t word_count(const JointName& name) {
  constexpr std::string_view kSaysNothing[] = {"def",   "bind", "bnd", "jnt",
                                               "joint", "bone", "skin"};
  return static_cast<size_t>(
      std::count_if(name.words.begin(), name.words.end(), [&](const std::string& word) {
        return std::find(std::begin(kSaysNothing), std::end(kSaysNothing), word) ==
               std::end(kSaysNothing);
      }));
}

bool is_standard_name_of(const JointName& name, HumanJoint joint) {
  const std::string text = plain(name, false);
  return std::any_of(std::begin(kStandards), std::end(kStandards), [&](const Standard& standard) {
    if (standard.name != text) return false;
    const int left = index(standard.joint), right = kHumanMirror[left];
    if (left == right) return name.side == Side::none && joint == standard.joint;
    return (name.side == Side::left && index(joint) == left) ||
           (name.side == Side::right && index(joint) == right);
  });
}

bool is_standard_piece_of(const JointName& name, HumanJoint joint) {
  if (name.side != Side::none) return false;
  const std::string text = plain(name, true);
  if (joint == neck) return text == "neck";
  // A spine without a number is below the chest.
  const bool numbered = text != plain(name, false);
  return joint == chest &&
         (text == "chest" || text == "upperchest" || (numbered && text == "spine"));
}

bool is_standard_name(const JointName& name) {
  const std::string text = plain(name, true);
  return text == "upperchest" ||
         std::any_of(std::begin(kStandards), std::end(kStandards),
                     [&](const Standard& standard) { return standard.name == text; });
}

}  // namespace panache
