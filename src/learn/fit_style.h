#pragma once
// Fits a style in closed form: its head by ridge regression, and its gate, on the activations of a
// fixed trunk.

#include <memory>
#include <span>

#include "learn/samples.h"
#include "net/safetensors.h"
#include "style/model/model.h"

namespace panache {

// The tensors of a learnt style for a style file: `head.*`, `mean` and `gate.*`, see Model. Fitted
// to the given samples of the set (with the model's recipe), each as it is and in eight disturbed
// copies, which are the same in every call. `model` must be able to learn. At least one sample.
// `penalty`: the cost of a squared weight, in variances of a standardised feature. `strength`: the
// fraction of the samples' change that is learnt.
TensorFile fit_style(const std::shared_ptr<const Model>& model, const SampleSet& set,
                     std::span<const size_t> samples, double penalty, double strength = 1);

// The same for a style that is a single change of posture for all motion; it does not change tempo
// or contacts.
TensorFile fit_posture(const Model& model, const StyleDelta& change);

// Adds to a model file what it needs to learn: `learn.mean` and `learn.scale`, mean and deviation
// of the activations over the windows of `takes` (layout positions). Activations standardised by
// them distinguish styles that were not in the training. Fails with Model::create()'s message, or
// if the recipe does not allow learning styles.
Result<void> add_activation_statistics(const std::vector<Take>& takes, TensorFile& model);

}  // namespace panache
