#pragma once
// How a remover is trained: the pairs are reversed, from the styled take to the neutral one. Motion
// without styles is restyled by the model whose remover it is, and the remover learns the way back:
// other people and other actions than those of the styled takes.

#include <optional>
#include <vector>

#include "base/result.h"
#include "learn/samples.h"
#include "style/model.h"
#include "style/names.h"
#include "train/training_data.h"

namespace panache {

// The pairing of the neutral take's whole frames with the frames of the styled take, each in the
// other's place; absent where it has no frame but its first and last ones.
std::optional<Pairing> reversed(const Pairing& pairing);

// The one of a sample's two takes that shows a style; of two neutral ones the first.
int take_with_style(const std::vector<Take>& takes, const Sample& sample);

// Restyles a part of each of the `unlabelled` rows that are not held out in a style of `model`,
// adds both to the takes of `data`, and fills its `removal`: all pairings reversed, each for its
// style and once more for kAnyStyle, which also learns to leave neutral takes alone. Fails where a
// file cannot be read.
Result<void> prepare_removal(const Model& model, const std::vector<ManifestRow>& unlabelled,
                             uint64_t seed, TrainingData& data);

}  // namespace panache
