#pragma once
// Training on motion that has no styled counterpart. Classifiers of the styles tell whether the
// pose network's output looks like the style; other losses preserve the original motion.
// docs/method.md, "Generalising to other actions", gives the reason for each.

#include <vector>

#include <torch/types.h>

#include "learn/samples.h"
#include "takes/signature.h"
#include "train/batches.h"
#include "train/classifier.h"
#include "train/network.h"
#include "train/statistics_guide.h"
#include "train/unlabelled.h"

namespace panache {

// Classes are the styles in order and then neutral. The guides are of two families: what both agree
// on is the style, not a weakness of one of them.
struct Guides {
  Classifier networks;
  StatisticsGuide statistics;
};
// Trains on the takes that the samples were made from.
Guides train_guides(const std::vector<Take>& takes, const SampleSet& set,
                    const std::vector<int>& choice, const std::vector<std::string>& styles,
                    const GuidanceSettings& settings, uint64_t seed);

// Similarity of the movement of hands, forearms and feet: 1 - correlation of their velocities, or 1
// - covariance / variance of the input where the output moves less; joints that move more weigh
// more. Both [sequences][instants][21][3], metres.
torch::Tensor velocity_loss(const torch::Tensor& in, const torch::Tensor& out);

// Changes of the first traits of kTraits, those that one second of motion shows, in their units.
// before, after: [sequences][instants][21][3] -> [sequences][kGuidedTraits]
inline constexpr int64_t kGuidedTraits = 7;
torch::Tensor trait_changes(const torch::Tensor& before, const torch::Tensor& after);

class Guidance {
 public:
  // For recipes with layout positions that output a packed StyleDelta without a mean.
  // `signatures`: one for each style, in order; null for a style without one.
  Guidance(const SampleSet& set, const std::vector<int>& choice, const OutputUnits& units,
           const UnlabelledMotion& motion, Guides guides,
           const std::vector<const Signature*>& signatures, const GuidanceSettings& settings,
           float input_clip);

  // The term to add to the pose network's loss after this share of the training.
  torch::Tensor loss(const NetworkTrainer& pose, double share, Random& random) const;
  // Likewise for the timing network: draws the mean tempo of a sequence to that of the style's real
  // takes, if they agree on one.
  torch::Tensor tempo_loss(const NetworkTrainer& timing, double share, Random& random) const;

  // Undisturbed windows of the motion as network inputs. [sequences * instants][inputs]
  torch::Tensor windows(int sequences, Random& random) const;

 private:
  // Sequences sorted by style, as the heads require.
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
  // The style's mean change in the pairs, actions weighted alike. [styles][outputs]
  torch::Tensor style_mean_, style_deviation_;
  // Each style's change of the guided traits, and the tolerance; infinite without a signature.
  torch::Tensor signature_, tolerance_;  // [styles][kGuidedTraits]
  // The same for the logarithm of the tempo; also infinite where real takes disagree.
  torch::Tensor tempo_, tempo_tolerance_;  // [styles]
};

}  // namespace panache
