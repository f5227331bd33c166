#pragma once
// Batches: which samples a network sees at a step, disturbed, mirrored and normalised. Everything
// follows from the seed and the step, so that interrupted training goes on as if it had not been.

#include <vector>

#include <torch/torch.h>

#include "learn/samples.h"

namespace panache {

struct BatchSettings {
  int size = 256;
  // Rows grouped by style and in pairs of neighbouring frames, drawn by the square root of the
  // share that each action in each style has; else one by one from all.
  bool by_style = false;
  bool mirrored = false;  // Half of the rows left for right.
  bool disturbed = false;
  Disturbance disturbance;
  float input_clip = 0;  // Normalised inputs are held within this many deviations; 0: not.
  std::vector<float> output_mean, output_scale;  // [outputs]
};

struct Batch {
  torch::Tensor inputs;              // [rows][inputs (+ styles + 1 where styles are an input)]
  torch::Tensor pose;                // [rows][outputs], normalised
  torch::Tensor log_rate;            // [rows][1]
  torch::Tensor contacts;            // [rows][2]
  std::vector<int64_t> group_sizes;  // Rows of each style, where grouped.
};

class BatchMaker {
 public:
  // `choice`: the samples to draw from. `styles`: how many the model has; `style_input`: whether
  // the style vector is appended to the window, neutral first.
  BatchMaker(const SampleSet& set, std::vector<int> choice, int styles, bool style_input,
             BatchSettings settings);

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
  bool style_input_;
  BatchSettings settings_;
  struct Cell {
    int style;
    std::vector<int> samples;  // Of choice_, those with a next one.
    float share;               // Of this cell and those before it.
  };
  std::vector<Cell> cells_;  // One for each action in each style.
};

}  // namespace panache
