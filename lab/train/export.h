#pragma once
// Exports trained networks to a model file, and checks that both compute the same.

#include <map>
#include <string>
#include <vector>

#include "takes/manifest.h"
#include "train/batches.h"
#include "train/network.h"
#include "train/trainer.h"

namespace panache {

// The three networks of the set's recipe: hidden layers of 128, 64 and 32 units, as in the slides.
std::vector<NetworkShape> network_shapes(const SampleSet& set, int styles);

// The metadata of every model file with these styles.
std::map<std::string, std::string> model_metadata(const Recipe& recipe,
                                                  const std::vector<StyleName>& styles);

TensorFile export_model(const SampleSet& set, const OutputUnits& units,
                        const std::vector<StyleName>& styles,
                        const std::vector<NetworkTrainer>& networks, const TrainOptions& options);

// Reads `model` back from its bytes and compares it with the trained networks on up to 200 of
// `samples`: the largest difference of any output, relative to that output's scale.
Result<float> export_error(const TensorFile& model, const SampleSet& set, const BatchMaker& batches,
                           const std::vector<NetworkTrainer>& networks,
                           const std::vector<int>& samples);

}  // namespace panache
