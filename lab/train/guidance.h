#pragma once
// Training on motion that has no styled counterpart. A classifier that learnt the styles tells
// whether what the pose network makes of it looks like the style; other losses keep it the motion
// that it was: docs/method.md, "Generalising to other actions", says why each is there.

#include <vector>

#include <torch/types.h>

#include "learn/samples.h"
#include "learn/signature.h"
#include "train/batches.h"
#include "train/classifier.h"
#include "train/network.h"
#include "train/statistics_guide.h"
#include "train/unlabelled.h"

namespace panache {

// The guides know the styles (classes in this order) and, last, neutral. They are of two families,
// so that what they agree on is the style and not a weakness of one of them.
struct Guides {
  Classifier networks;
  StatisticsGuide statistics;
};
// From the takes that the samples were made of.
Guides train_guides(const std::vector<Take>& takes, const SampleSet& set,
                    const std::vector<int>& choice, const std::vector<std::string>& styles,
                    const GuidanceSettings& settings, uint64_t seed);

// How hands, forearms and feet move in and out: 1 - correlation of their velocities, or 1 -
// covariance / variance of the input's where they move less than it; those that move more count
// more. Both [sequences][instants][21][3], metres.
torch::Tensor velocity_loss(const torch::Tensor& in, const torch::Tensor& out);

// The change of the first traits of kTraits, those that a second of motion shows, in their units.
// before, after: [sequences][instants][21][3] -> [sequences][kGuidedTraits]
inline constexpr int64_t kGuidedTraits = 7;
torch::Tensor trait_changes(const torch::Tensor& before, const torch::Tensor& after);

class Guidance {
 public:
  // Of recipes with layout positions that answer with a packed StyleDelta without a mean.
  // `signatures`: of the styles in their order; null where a style has none.
  Guidance(const SampleSet& set, const std::vector<int>& choice, const OutputUnits& units,
           const UnlabelledMotion& motion, Guides guides,
           const std::vector<const Signature*>& signatures, const GuidanceSettings& settings,
           float input_clip);

  // What to add to the pose network's loss, after this share of the training.
  torch::Tensor loss(const NetworkTrainer& pose, double share, Random& random) const;
  // The same for the timing network: the mean tempo of a sequence should be that of the style's
  // real takes, where they agree on one.
  torch::Tensor tempo_loss(const NetworkTrainer& timing, double share, Random& random) const;

  // Undisturbed windows of the motion as networks see them. [sequences * instants][inputs]
  torch::Tensor windows(int sequences, Random& random) const;

 private:
  // Sequences in order of their styles, as the heads want them.
  struct Drawn {
    torch::Tensor windows;             // [sequences * instants][inputs], not normalised
    torch::Tensor styles;              // [sequences]
    std::vector<int64_t> group_sizes;  // Windows of each style.
  };
  Drawn draw(Random& random) const;
  torch::Tensor normalised(const torch::Tensor& windows) const;

  const UnlabelledMotion& motion_;
  const Guides guides_;
  const GuidanceSettings settings_;
  const int styles_;
  const float input_clip_;
  const InputUnits input_units_;
  torch::Tensor input_mean_, input_factor_;  // [inputs]
  torch::Tensor output_scale_;               // [outputs]
  // Of the style's change in the pairs, actions weighted alike. [styles][outputs]
  torch::Tensor style_mean_, style_deviation_;
  // What each style changes of the guided traits, and what it may be off; infinite where there is
  // no signature.
  torch::Tensor signature_, tolerance_;  // [styles][kGuidedTraits]
  // The same of the logarithm of the tempo; also infinite where real takes do not agree on it.
  torch::Tensor tempo_, tempo_tolerance_;  // [styles]
};

}  // namespace panache
