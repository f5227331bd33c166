#pragma once
// Motions of a file put on a character, as they are: what panache retarget and convert --onto do.

#include <string>

#include "batch.h"
#include "new_motions.h"
#include "onto.h"
#include "rig/rig.h"

namespace panache::cli {

// Writes file.output: the character with the motions of file.input, or with the one called `clip`
// where that is not empty. `rig`: what the user says of the motion's rig.
Result<void> retarget_file(FileJob& file, const CharacterFile& character, const std::string& clip,
                           const RigOptions& rig, const RetargetOptions& options,
                           const PlaceFlags& flags, bool force);

}  // namespace panache::cli
