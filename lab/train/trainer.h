#pragma once
// Trains a model from manifests: pairs, samples, networks, a file.

#include <functional>
#include <memory>
#include <limits>
#include <string>
#include <vector>

#include "base/result.h"
#include "takes/manifest.h"
#include "learn/samples.h"
#include "net/safetensors.h"
#include "recipes/recipe.h"
#include "style/model/model.h"
#include "train/coverage.h"
#include "train/training_data.h"

namespace panache {

struct TrainOptions {
  explicit TrainOptions(const Recipe& what = default_recipe())
      : recipe(&what), settings(what.training) {}

  const Recipe* recipe;
  TrainingSettings settings;  // The recipe's own, or modified.
  // The model to train a remover for, or null. Pairs are reversed, and the training also uses
  // unlabelled motion restyled by this model. See removal.h.
  std::shared_ptr<const Model> remover_of;
  uint64_t seed = 1;
  std::string data, licence;  // Description and licence of the data, for the model's metadata.
  std::string checkpoint;     // File to resume from and to save to regularly; empty: none.
  // Gets a message for everything left out of the takes, before training begins; may be empty.
  std::function<void(const std::string&)> note;
};

// One line of the loss table.
struct LossPoint {
  std::string network;
  int64_t step = 0;
  float train = 0;  // Mean since the previous line.
  // On takes held back from training; NaN if there are none.
  float validation = std::numeric_limits<float>::quiet_NaN();
};

struct Trained {
  TensorFile model;
  std::vector<LossPoint> losses;
  size_t samples = 0;
  std::vector<StyleCoverage> styles;  // In the model's order.
  double read_seconds = 0, pair_seconds = 0, train_seconds = 0;
  float export_error =
      0;  // Largest difference between the exported model's outputs and libtorch's.
};

// Trains on prepared takes of any layout. Fails if a style has no samples.
Result<Trained> train(TrainingData data, const std::vector<StyleName>& styles,
                      const TrainOptions& options);

// Trains on the training split of `rows`, with styles already renamed as in `styles`, and of
// `unlabelled`, with styles ignored. A remover has one more style, kAnyStyle.
Result<Trained> train(const std::vector<ManifestRow>& rows, const std::vector<StyleName>& styles,
                      const TrainOptions& options, const std::vector<ManifestRow>& unlabelled = {});

// "network,step,train,validation" lines, with empty cells for missing values; and the same as a
// picture.
std::string losses_csv(const std::vector<LossPoint>& losses);
std::string losses_svg(const std::vector<LossPoint>& losses);

}  // namespace panache
