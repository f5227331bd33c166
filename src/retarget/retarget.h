#pragma once
// Retargets a motion to another character with its rest pose, proportions, units and axes.

#include <utility>
#include <vector>

#include "base/result.h"
#include "clip/clip.h"
#include "pose/contacts.h"
#include "rig/rig.h"

namespace panache {

struct RetargetOptions {
  bool feet = true;   // Feet on the floor, and planted where the motion plants them.
  bool hands = true;  // Hands that touch keep touching.
  // The path over the ground goes to the character's root joint, if it has one on the floor above
  // its hips; otherwise to the hips.
  bool root = true;
};

struct Retargeted {
  Clip clip;                           // On the character's skeleton, at the motion's rate.
  std::vector<FootContacts> contacts;  // Per frame of it, as in the motion.
};

// Puts `motion` (whose rig is `rig`) on the skeleton of `character` (whose rig is `onto`), at the
// motion's rate, without a leading calibration pose. A motion that is on this skeleton already is
// copied. Otherwise limbs keep their directions, the hips'
// position is scaled by the ratio of the legs; fingers and twist joints follow if both rigs have
// them, and all other joints keep their rest pose, or their mean pose in the frames of `character`
// if its rest pose does not stand. These frames also define its floor and then its axes. From one
// VRM to another, the front stays the front. Fails if neither the character's hips nor a joint
// above them can move.
Result<Retargeted> retarget(const Clip& motion, const Rig& rig, const Clip& character,
                            const Rig& onto, const RetargetOptions& options = {});

// The clip for retarget()'s `character`, and its rig: the rest pose if it stands on the floor, else
// the first motion on the joints of `rest`. `motion` may be null.
Result<std::pair<Clip, Rig>> find_body(Clip rest, const Clip* motion, const RigOptions& options);

}  // namespace panache
