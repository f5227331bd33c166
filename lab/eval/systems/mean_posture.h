#pragma once
// The simplest system that is one: each style's mean change over its training pairs, whatever the
// motion. Mean posture, mean tempo, no foot ever planted.

#include "eval/systems/table.h"

namespace panache {

// Its answer to each style, from the pairs of `data`.
std::vector<Model::ConstantStyle> mean_changes(const SystemData& data);

// Moves whole clips as a model of ours does.
Result<std::unique_ptr<System>> make_mean_posture(const std::string& name, const SystemData& data);

}  // namespace panache
