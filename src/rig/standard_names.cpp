#include "rig/standard_names.h"

#include <algorithm>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

namespace panache {
namespace {

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

// The words that say something, run together: no "def", no "bip 01", no "cc base", and no number
// at the end where `numbered`.
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
  // One spine alone is below the chest.
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
