#pragma once
// The names that standards and tools give the humanoid joints: VRM and glTF, Mixamo, Unreal, Unity,
// 3ds Max. Private to the folder.

#include "rig/humanoid.h"
#include "rig/joint_name.h"

namespace panache {

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
