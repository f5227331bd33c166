#pragma once
// Motions of a file put on a character, as they are: what panache retarget and convert --onto do.

#include <string>

#include "batch.h"
#include "formats.h"
#include "new_motions.h"
#include "onto.h"
#include "rig_options.h"

namespace panache::cli {

struct RetargetFlags {
  BatchFlags batch;
  ReadOptions read;
  RigFlags rig;
  OntoFlags onto;
  PlaceFlags place;
  FigureFlags figure;
  std::string clip;  // The motion to take, or empty for all.
  bool in_place = false;
};

// Writes the character with the motions of each input. `doing`, `done`: as for run_batch(). The
// exit code.
int retarget_files(const RetargetFlags& flags, const RetargetOptions& options,
                   const std::string& doing, const std::string& done);

}  // namespace panache::cli
