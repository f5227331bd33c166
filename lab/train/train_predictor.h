#pragma once
// Trains the network that predicts input, on takes of all styles.

#include <functional>
#include <vector>

#include "learn/take.h"
#include "net/safetensors.h"
#include "train/trainer.h"

namespace panache {

// Trains a predictor (see Predictor) on the takes and adds its tensors to `model`. Appends to
// `losses` the error of positions 0.05 to 0.25 s ahead, relative to that of holding the pose or of
// constant velocity, whichever is smaller. Skips takes shorter than half a second; adds nothing if
// none is left. `progress` gets 0 to 1.
void train_predictor(const std::vector<Take>& takes, int64_t steps, uint64_t seed,
                     const std::function<void(double)>& progress, TensorFile& model,
                     std::vector<LossPoint>& losses);

}  // namespace panache
