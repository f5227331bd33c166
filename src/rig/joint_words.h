#pragma once
// The meaning of the words of a joint's name. Private to the folder.

#include "rig/humanoid.h"
#include "rig/joint_name.h"

namespace panache {

bool is_hand(const JointName& name);  // Or wrist.
bool is_foot(const JointName& name);  // Or ankle; no toe.
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
// Something near a hand, a foot or a head, but not it: a finger, a target, a tip, a prop.
bool is_near(const JointName& name);
// Something that sits on a head: a jaw, an eye, a strand of hair.
bool is_on_head(const JointName& name);
// How many words of the name say more than that it is a joint.
size_t word_count(const JointName& name);

// The names that standards and tools give the humanoid joints: VRM and glTF, Mixamo, Unreal, Unity,
// 3ds Max.

// Whether the whole name, but for prefixes such as "mixamorig:", "Bip01" or "DEF-", is a standard's
// own for that joint: "chest", "upperarm_l", "Bip01 L Clavicle". A number behind it makes another
// name, as it counts the pieces of a chain.
bool is_standard_name_of(const JointName& name, HumanJoint joint);

// Whether it is one for a piece of the torso or the neck, of which there may be several: a name of
// spine or chest for `chest`, of the neck for `neck`, a number behind it or not ("spine_03",
// "upperChest", "neck_01").
bool is_standard_piece_of(const JointName& name, HumanJoint joint);

// Whether it is one for any joint, or with a number behind it for one of a chain ("spine_03"), or
// "upperChest".
bool is_standard_name(const JointName& name);

}  // namespace panache
