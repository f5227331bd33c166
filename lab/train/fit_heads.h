#pragma once
// The styles' pose heads in closed form, on the activations of all layers of the trained pose
// trunk; and the gate, an ellipsoid around those activations.

#include <cstdint>
#include <torch/types.h>
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

// Adds gate.mean, gate.whitening and gate.limit to a model: mean and covariance of the pose trunk's
// activations on training windows, and the distance beyond which the gate closes gradually:
// `trusted` times that which 99 % of the windows are within. activations[rows][hidden].
inline constexpr double kTrusted = 0.61;
// Styled motion varies more than neutral motion: with kTrusted, a remover would leave part of the
// style in takes that it can make neutral.
inline constexpr double kTrustedByRemovers = 1.83;
void fit_gate(const torch::Tensor& activations, TensorFile& file, double trusted = kTrusted);

}  // namespace panache
