#pragma once
// Batches: draws samples for a training step, then disturbs, mirrors and normalises them. The
// result depends only on the seed and the step, so training can be resumed exactly.

#include <vector>

#include <torch/types.h>

#include "learn/disturbance.h"
#include "learn/samples.h"

namespace panache {

// Normalisation of the pose network's targets: (target - mean) / scale. [outputs]
struct OutputUnits {
  std::vector<float> mean, scale;
};
// The recipe's own scale, or one measured on the targets of these samples.
OutputUnits output_units(const SampleSet& set, const std::vector<int>& samples);

struct Batch {
  torch::Tensor inputs;              // [rows][inputs and Recipe::style_inputs()]
  torch::Tensor pose;                // [rows][outputs], normalised
  torch::Tensor log_rate;            // [rows][1]
  torch::Tensor contacts;            // [rows][2]
  std::vector<int64_t> group_sizes;  // Rows of each style, if grouped.
};

class BatchMaker {
 public:
  // `choice`: the samples to draw from. `styles`: number of styles in the model.
  BatchMaker(const SampleSet& set, std::vector<int> choice, int styles,
             const BatchSettings& settings, OutputUnits units);

  Batch make(Random& random) const;
  // The given samples in order, undisturbed, for validation.
  Batch plain(const std::vector<int>& samples) const;

  // The same, each disturbed.
  Batch disturbed(const std::vector<int>& samples, Random& random) const;

  const std::vector<int>& choice() const { return choice_; }

 private:
  struct Row {
    int sample;
    bool mirrored;
    int disturbed;  // Index of the draw, -1 for none.
  };
  Batch fill(const std::vector<Row>& rows, const std::vector<Disturbed>& draws,
             Random* random) const;

  const SampleSet& set_;
  std::vector<int> choice_;
  int styles_;
  BatchSettings settings_;
  OutputUnits units_;
  struct Cell {
    int style;
    std::vector<int> samples;  // Members of choice_ that have a next sample.
    float share;               // Cumulative, including this cell.
  };
  std::vector<Cell> cells_;  // One for each action and style.
};

}  // namespace panache
