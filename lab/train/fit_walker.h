#pragma once
// Fits the walker to neutral walks, runs and turns.

#include <string>
#include <vector>

#include "base/result.h"
#include "takes/manifest.h"
#include "walker/walker_model.h"

namespace panache {

struct FittedWalker {
  WalkerModel model;
  // Size of the training data: takes and frames (mirrored ones not counted).
  int takes = 0, walk_frames = 0, run_frames = 0;
  // Root mean square of the residual rotation vectors, radians.
  double walk_residual = 0, run_residual = 0;
};

// Uses the neutral takes of `rows` that are not held out: contents walk, walk-turn-left and
// walk-turn-right for the walk; run and dash for the run. Each take is used twice, once mirrored.
// The standing pose is the mean walking pose on straight legs.
Result<FittedWalker> fit_walker(const std::vector<ManifestRow>& rows, const std::string& data,
                                const std::string& licence);

}  // namespace panache
