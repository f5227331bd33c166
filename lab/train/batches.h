#pragma once
// Batches: which samples a network sees at a step, disturbed, mirrored and normalised. Everything
// follows from the seed and the step, so that interrupted training goes on as if it had not been.

#include <vector>

#include <torch/types.h>

#include "learn/disturbance.h"
#include "learn/samples.h"

namespace panache {

// How the pose network's targets are normalised: less the mean, divided by the scale. [outputs]
struct OutputUnits {
  std::vector<float> mean, scale;
};
// The recipe's own scale, or what is measured on the targets of these samples.
OutputUnits output_units(const SampleSet& set, const std::vector<int>& samples);

struct Batch {
  torch::Tensor inputs;              // [rows][inputs and Recipe::style_inputs()]
  torch::Tensor pose;                // [rows][outputs], normalised
  torch::Tensor log_rate;            // [rows][1]
  torch::Tensor contacts;            // [rows][2]
  std::vector<int64_t> group_sizes;  // Rows of each style, where grouped.
};

class BatchMaker {
 public:
  // `choice`: the samples to draw from. `styles`: how many the model has.
  BatchMaker(const SampleSet& set, std::vector<int> choice, int styles,
             const BatchSettings& settings, OutputUnits units);

  Batch make(Random& random) const;
  // The samples themselves, undisturbed, in order: for validation.
  Batch plain(const std::vector<int>& samples) const;

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
    std::vector<int> samples;  // Of choice_, those with a next one.
    float share;               // Of this cell and those before it.
  };
  std::vector<Cell> cells_;  // One for each action in each style.
};

}  // namespace panache
