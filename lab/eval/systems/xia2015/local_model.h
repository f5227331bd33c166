#pragma once
// The local model: a mixture of autoregressive models, fitted on the fly to the neighbours of one
// window.

#include <array>
#include <span>
#include <vector>

#include "eval/systems/xia2015/database.h"

namespace panache::xia2015 {

struct LocalSettings {
  size_t neighbours = 80;  // At most a fifth of the examples.
  int components = 2;
  // Penalty on the linear maps, relative to the neighbours' mean square deviation.
  float penalty = 0.2f;
  // Weight of the recent output relative to the window in the input of the maps.
  float recent = 0.8f;
};

using Output = std::array<float, kOutputs>;  // As in Database::Example.

struct LocalAnswer {
  Output output;
  float rate = 1;
  std::array<float, kFeet> contacts{};
};

// `neighbours`: of `key` in `database`, not empty. `recent`: the output one frame ago, or null.
LocalAnswer answer_locally(const Database& database,
                           const std::vector<Database::Neighbour>& neighbours,
                           std::span<const float, kKeySize> key, const Output* recent,
                           const LocalSettings& settings);

}  // namespace panache::xia2015
