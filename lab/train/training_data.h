#pragma once
// Reads the training motion, and pairs takes of styles with neutral ones.

#include <string>
#include <vector>

#include "base/result.h"
#include "takes/manifest.h"
#include "learn/pairing.h"
#include "learn/samples.h"
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

// performers.cpp: performers without a neutral take. Their styles are paired with other performers'
// neutral takes, so each change contains both the style and the difference between two persons. The
// second part is common to all styles of a performer. See docs/method.md, "Performers".
// Subtracts from the targets (packed StyleDeltas) the difference between a performer without a
// neutral take of an action and the others: per output, the median over the performer's styles,
// shrunk by how much persons vary compared with styles (Wiener's estimate), and at most as large as
// persons differ. Both variances are measured on performers with neutral takes; with fewer than
// three of these, nothing is subtracted. `takes`: the ones that the set was made from.
void take_off_performers(const std::vector<Take>& takes, SampleSet& set);

}  // namespace panache
