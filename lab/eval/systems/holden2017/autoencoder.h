#pragma once
// The loss network: a convolutional autoencoder of motion, whose hidden units represent content and
// style.

#include <torch/types.h>

#include "eval/systems/holden2017/convolution.h"
#include "eval/systems/holden2017/motion_rows.h"

namespace panache::holden2017 {

struct AutoencoderSettings {
  int units = 128;
  int steps = 1500;
  int batch = 16;
};

class Autoencoder {
 public:
  // Learns to reconstruct windows of normalised rows with a tenth of the values masked.
  // Deterministic for a seed.
  Autoencoder(const Windows& windows, uint64_t seed, const AutoencoderSettings& settings = {});

  // rows[windows][kRows][frames], an even number of frames -> [windows][units][frames / 2]
  torch::Tensor encode(const torch::Tensor& rows) const;
  torch::Tensor decode(const torch::Tensor& hidden) const;

 private:
  Convolution encoder_, decoder_;
};

// The Gram matrix of hidden units: [windows][units][units], the mean over time of their products.
torch::Tensor gram(const torch::Tensor& hidden);

}  // namespace panache::holden2017
