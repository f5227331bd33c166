#pragma once
// One style's feed-forward network, trained against the loss network.

#include <vector>

#include <torch/types.h>

#include "eval/systems/holden2017/autoencoder.h"

namespace panache::holden2017 {

struct TransferSettings {
  int units = 96;  // Per hidden layer, of which there are two.
  int steps = 600;
  int batch = 8;
  // Weights of the loss terms.
  double content = 1, style = 30, bones = 20, feet = 1, trajectory = 1, smoothness = 5;
};

// Examples of a style: neutral motion of some actions, and styled motion of the same actions.
struct StyleMotion {
  struct Action {
    std::vector<torch::Tensor> neutral, styled;  // Normalised rows, [kRows][frames].
  };
  std::vector<Action> actions;
};

class Transfer {
 public:
  Transfer(const Autoencoder& loss_network, const RowUnits& units, const StyleMotion& motion,
           uint64_t seed, const TransferSettings& settings = {});

  // Applies the style to normalised rows, [windows][kRows][frames].
  torch::Tensor operator()(const torch::Tensor& rows) const;
  size_t parameters() const;

 private:
  Convolution first_, second_, last_;
};

}  // namespace panache::holden2017
