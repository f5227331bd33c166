#pragma once
// Reads the training motion, and pairs takes of styles with neutral ones.

#include <string>
#include <vector>

#include "base/result.h"
#include "learn/manifest.h"
#include "learn/pairing.h"
#include "learn/take.h"

namespace panache {

// Takes of the training split, read and paired: the input of all recipes.
struct TrainingData {
  std::vector<Take> takes;
  std::vector<Pairing> pairings;
  std::vector<Take> unlabelled;  // Motion without styles, for guidance.
  std::vector<Pairing> removal;  // For a remover, instead of `pairings`: see prepare_removal().
  double read_seconds = 0, pair_seconds = 0;
};
Result<TrainingData> prepare_training(const std::vector<ManifestRow>& rows, PoseLayout layout,
                                      const std::vector<ManifestRow>& unlabelled = {});

// The takes of `rows` that are not held out. `what`: title of the progress bar.
Result<std::vector<Take>> read_training_takes(const std::vector<ManifestRow>& rows,
                                              PoseLayout layout, const std::string& what);

// Which takes are held back for validation: about 5 %, by a hash of the file name. Whole takes,
// because neighbouring frames are nearly copies of each other. At least one take of each set, style
// and action stays in training. [takes]
std::vector<bool> validation_takes(const std::vector<Take>& takes);

}  // namespace panache
