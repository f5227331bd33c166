#pragma once
// Identifies a training, so that a checkpoint resumes only the training that it belongs to.

#include <cstdint>
#include <vector>

#include "takes/manifest.h"
#include "learn/samples.h"
#include "train/trainer.h"

namespace panache {

// Hashes of everything that determines the result.
struct Fingerprint {
  uint64_t data = 0;      // Content of the takes, their pairing, and the training split.
  uint64_t styles = 0;    // Names, in order.
  uint64_t settings = 0;  // The recipe's settings, and the seed.
};

// `set`: the samples of the takes; `choice`: those that are trained on.
Fingerprint fingerprint(const TrainingData& data, const SampleSet& set,
                        const std::vector<int>& choice, const std::vector<StyleName>& styles,
                        const TrainOptions& options);

}  // namespace panache
