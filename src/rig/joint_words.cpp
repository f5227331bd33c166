#include "rig/joint_words.h"

#include <algorithm>
#include <initializer_list>
#include <iterator>
#include <string_view>

namespace panache {
namespace {

using Words = std::initializer_list<std::string_view>;

bool has_any(const JointName& name, Words words) {
  return std::any_of(words.begin(), words.end(), [&](auto word) { return name.has(word); });
}
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

}  // namespace panache
