#pragma once
// The styles' pose heads in closed form, on the activations of all layers of the trained pose
// trunk. Gradient steps on the last layer alone lose half of a style's movement.

#include <cstdint>
#include <vector>

#include "learn/samples.h"
#include "net/safetensors.h"
#include "train/batches.h"
#include "train/guidance.h"
#include "train/network.h"

namespace panache {

// Replaces the pose heads of `model` (an exported file with `learn.mean` and `learn.scale`) by
// ridge regressions on the samples of `choice`, undisturbed and disturbed, and, with guidance, on
// the trained heads' answers to its motion, where that is unlike the samples. Each is reduced to
// settings.rank combinations of activations: `pose.reduce.STYLE` and `pose.head.STYLE`.
void fit_heads(const SampleSet& set, const std::vector<int>& choice, const OutputUnits& units,
               const BatchSettings& batch, const HeadSettings& settings, const Guidance* guidance,
               const NetworkTrainer& pose, uint64_t seed, TensorFile& model);

}  // namespace panache
