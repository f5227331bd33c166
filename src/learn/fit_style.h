#pragma once
// Fits a style in closed form: its head by ridge regression, and its gate, on the activations of a
// fixed trunk.

#include <memory>
#include <span>
#include <vector>

#include "learn/samples.h"
#include "net/safetensors.h"
#include "style/model/model.h"

namespace panache {

// Linear least squares with a penalty on each unknown.

// Finds the weights[unknowns][outputs] that bring row * weights near to the outputs of each row.
class Ridge {
 public:
  Ridge(int unknowns, int outputs);

  // Adds a row, or several with the same weight. rows[...][unknowns], outputs[...][outputs]
  void add(std::span<const double> rows, std::span<const double> outputs, double weight = 1);
  // penalties[unknowns], not negative: the cost of a squared weight. With `prior`
  // ([unknowns][outputs], or empty for zero), the cost of the squared distance from the prior. The
  // rows and penalties together must determine every unknown.
  std::vector<double> solve(std::span<const double> penalties,
                            std::span<const double> prior = {}) const;

  // Weighted sum of row^T row. [unknowns][unknowns]
  std::vector<double> gram() const;

 private:
  const size_t unknowns_, outputs_;
  std::vector<double> gram_;    // [unknowns][unknowns], lower triangle only
  std::vector<double> target_;  // [unknowns][outputs]
};

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
