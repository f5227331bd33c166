#pragma once
// Training of the network that predicts input: from all takes, of whatever style.

#include <functional>
#include <vector>

#include "learn/take.h"
#include "net/safetensors.h"
#include "train/trainer.h"

namespace panache {

// Trains a predictor (see Predictor) on the takes and adds its tensors to `model`. Lines of the
// loss table are added to `losses`: the error of positions 0.05 to 0.25 s ahead as a share of that
// of holding the pose or of constant velocity, whichever is less. Takes shorter than half a second
// are left out; without any other nothing is added. `progress` gets 0 to 1.
void train_predictor(const std::vector<Take>& takes, int64_t steps, uint64_t seed,
                     const std::function<void(double)>& progress, TensorFile& model,
                     std::vector<LossPoint>& losses);

}  // namespace panache
