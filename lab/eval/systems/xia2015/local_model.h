#pragma once
// The local model: a mixture of autoregressive models, fitted on the fly to the neighbours of one
// window.

#include <array>
#include <span>
#include <vector>

#include "eval/systems/xia2015/database.h"

namespace panache::xia2015 {

struct LocalSettings {
  size_t neighbours = 80;  // A fifth of the examples at most.
  int components = 2;
  // Penalty on the linear maps, as a share of the neighbours' mean square deviation.
  float penalty = 0.2f;
  // Weight of the recent output against the window in what the maps look at.
  float recent = 0.8f;
};

using Output = std::array<float, kOutputs>;  // As in Database::Example.

struct LocalAnswer {
  Output output;
  float rate = 1;
  std::array<float, kFeet> contacts{};
};

// `neighbours`: of `key` in `database`, not empty. `recent`: the output one frame ago; null where
// there is none.
LocalAnswer answer_locally(const Database& database,
                           const std::vector<Database::Neighbour>& neighbours,
                           std::span<const float, kKeySize> key, const Output* recent,
                           const LocalSettings& settings);

}  // namespace panache::xia2015
