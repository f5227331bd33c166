#pragma once
// Training of a remover: pairs are reversed, from the styled take to the neutral one. Motion
// without styles is restyled by the remover's model, and the remover learns to undo that: this
// covers more people and actions than the styled takes.

#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "learn/samples.h"
#include "learn/take.h"
#include "net/safetensors.h"
#include "style/model/model.h"
#include "train/training_data.h"

namespace panache {

// Swaps the two takes of a pairing, at the neutral take's whole frames; absent if it has no frame
// besides its first and last.
std::optional<Pairing> reversed(const Pairing& pairing);

// The sample's take that shows a style; if both are neutral, the first.
int take_with_style(const std::vector<Take>& takes, const Sample& sample);

// Restyles a part of each `unlabelled` row that is not held out with a style of `model`, adds both
// to the takes of `data`, and fills its `removal`: all pairings reversed, each once for its style
// and once for kAnyStyle, which also learns to leave neutral takes alone. Fails if a file cannot be
// read.
Result<void> prepare_removal(const Model& model, const std::vector<ManifestRow>& unlabelled,
                             uint64_t seed, TrainingData& data);

// Style recognition of a remover: a linear layer on statistics of its trunk.
// Adds the tensors of Model::Recognition to a model file. The classes are the styles of the model
// and neutral, named as in the rows of the takes. Fails if the file is not a model.
Result<void> add_recognition(const std::vector<Take>& takes, uint64_t seed, TensorFile& file);

}  // namespace panache
