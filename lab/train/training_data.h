#pragma once
// The motion that models are trained on: read, and where there are styles, paired.

#include <string>
#include <vector>

#include "base/result.h"
#include "learn/manifest.h"
#include "learn/pairing.h"
#include "learn/take.h"

namespace panache {

// Takes of the training split, read and paired: what all recipes learn from.
struct TrainingData {
  std::vector<Take> takes;
  std::vector<Pairing> pairings;
  std::vector<Take> unlabelled;  // Motion without styles: for recipes that guidance trains.
  std::vector<Pairing> removal;  // Of a remover, in place of `pairings`: see prepare_removal().
  double read_seconds = 0, pair_seconds = 0;
};
Result<TrainingData> prepare_training(const std::vector<ManifestRow>& rows, PoseLayout layout,
                                      const std::vector<ManifestRow>& unlabelled = {});

// The takes of `rows` that are not held out. `what` is the title of the progress bar.
Result<std::vector<Take>> read_training_takes(const std::vector<ManifestRow>& rows,
                                              PoseLayout layout, const std::string& what);

// Which of the takes are kept for validation: about a twentieth, told by the file's name. Whole
// takes: neighbouring frames are nearly copies of each other. Each action of each style in each set
// has at least one take that is trained on. [takes]
std::vector<bool> validation_takes(const std::vector<Take>& takes);

}  // namespace panache
