#pragma once
// Tells one training from another, so that an interrupted one goes on only where it was.

#include <cstdint>
#include <vector>

#include "learn/manifest.h"
#include "learn/samples.h"
#include "train/trainer.h"

namespace panache {

// Hashes of all that decides what a training makes.
struct Fingerprint {
  uint64_t data = 0;      // What the takes show, how they are paired, which of them train.
  uint64_t styles = 0;    // Names, in order.
  uint64_t settings = 0;  // The recipe's, and the seed.
};

// `set`: the samples of the takes; `choice`: those of them that are trained on.
Fingerprint fingerprint(const TrainingData& data, const SampleSet& set,
                        const std::vector<int>& choice, const std::vector<StyleName>& styles,
                        const TrainOptions& options);

}  // namespace panache
