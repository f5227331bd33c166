#pragma once
// Splits a joint's name into words and side, for the naming of any tool: "mixamorig:LeftHand",
// "Bip01 L Hand", "hand.L", "lHand".

#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "rig/humanoid.h"

namespace panache {

enum class Side { none, left, right };

struct JointName {
  Side side = Side::none;
  std::vector<std::string> words;  // Lower case, in order, without the side; numbers are words too.

  bool has(std::string_view word) const;
};

// Splits `name` at its last colon or bar (the part before is a namespace), then at everything that
// is not a letter or digit, between lower and upper case and between letters and digits. Of a name
// of more than 100 letters, the last 100 count.
JointName parse_joint_name(std::string_view name);

// Whether it has one of the words.
bool has_any(const JointName& name, std::initializer_list<std::string_view> words);

// The words without a trailing number, which counts the pieces of a limb ("forearm", "001").
std::vector<std::string> without_number(const std::vector<std::string>& words);

bool is_hand(const JointName& name);  // Or wrist.
bool is_foot(const JointName& name);  // Or ankle; not toe.
bool is_toe(const JointName& name);
bool is_head(const JointName& name);
bool is_neck(const JointName& name);
bool is_pelvis(const JointName& name);
bool is_spine(const JointName& name);
bool is_forearm(const JointName& name);  // Or elbow.
bool is_shin(const JointName& name);     // Or knee.
bool is_ankle(const JointName& name);
// A joint that only spreads another's twist or bend over the skin.
bool is_twist(const JointName& name);
// Something near a hand, foot or head: a finger, a target, a tip, a prop.
bool is_near(const JointName& name);
// Something that sits on a head: a jaw, an eye, a strand of hair.
bool is_on_head(const JointName& name);
// The number of meaningful words in the name.
size_t word_count(const JointName& name);

// Standard names of the humanoid joints: VRM and glTF, Mixamo, Unreal, Unity, 3ds Max.

// Whether the whole name, except for prefixes such as "mixamorig:", "Bip01" or "DEF-", is a
// standard name of that joint: "chest", "upperarm_l", "Bip01 L Clavicle". A name with a trailing
// number is different, as it counts the pieces of a chain.
bool is_standard_name_of(const JointName& name, HumanJoint joint);

// Whether it is a standard name for one of several pieces of the torso or neck: spine or chest for
// `chest`, neck for `neck`, with or without a trailing number ("spine_03", "upperChest",
// "neck_01").
bool is_standard_piece_of(const JointName& name, HumanJoint joint);

// Whether it is a standard name of any joint or, with a trailing number, of a piece of a chain
// ("spine_03"), or "upperChest".
bool is_standard_name(const JointName& name);

}  // namespace panache
