#pragma once
// A motion put on another character, in that one's own rest pose, proportions, units and axes.

#include <vector>

#include "base/result.h"
#include "clip/clip.h"
#include "pose/contacts.h"
#include "rig/rig.h"

namespace panache {

struct RetargetOptions {
  bool feet = true;   // Feet on the floor, and planted where the motion plants them.
  bool hands = true;  // Hands that met meet again.
};

struct Retargeted {
  Clip clip;                           // On the character's skeleton, at the motion's rate.
  std::vector<FootContacts> contacts;  // Per frame of it, as in the motion.
};

// The motion of `motion` (whose rig is `rig`) on the skeleton of `character` (whose rig is `onto`),
// at the motion's rate, without a calibration pose in front. Limbs get the directions that they
// have in the motion, hips its place and height times the ratio of the legs; fingers and twist
// joints follow where both rigs have them, and all that the motion does not have rests. The frames
// of `character` tell its floor and, where its rest pose does not stand, its axes. Fails where the
// character's hips can neither move nor any joint above them.
Result<Retargeted> retarget(const Clip& motion, const Rig& rig, const Clip& character,
                            const Rig& onto, const RetargetOptions& options = {});

}  // namespace panache
