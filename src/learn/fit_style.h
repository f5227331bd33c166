#pragma once
// A style in closed form: its head by ridge regression and its gate, on the activations of a trunk
// that stays as it is.

#include <memory>
#include <span>

#include "learn/samples.h"
#include "net/safetensors.h"
#include "style/model.h"

namespace panache {

// The tensors of a learnt style, as a style file has them: `head.*`, `mean` and `gate.*`, see
// Model. Fitted to these of the set's samples (of the model's recipe), each seen as it is and in
// eight disturbed copies, which are the same at every call. `model` can learn. At least one sample.
// `penalty`: what a weight's square costs, in variances of a standardised feature. `strength`: how
// much of what the samples change is learnt.
TensorFile fit_style(const std::shared_ptr<const Model>& model, const SampleSet& set,
                     std::span<const size_t> samples, double penalty, double strength = 1);

// The same of a style that is one change of posture, whatever the motion is; it changes neither
// tempo nor contacts.
TensorFile fit_posture(const Model& model, const StyleDelta& change);

// The activations of a window, standardised as they vary over motion of all kinds, tell styles
// apart that were not there in training. Adds `learn.mean` and `learn.scale`, that mean and
// deviation over the windows of `takes` (layout positions), to a model file, which can then learn.
// Fails with Model::create()'s message, or where no style can be learnt on its recipe.
Result<void> add_activation_statistics(const std::vector<Take>& takes, TensorFile& model);

}  // namespace panache
