#include "eval/systems/holden2017/autoencoder.h"

namespace panache::holden2017 {
namespace {

constexpr double kRate = 1e-3;
constexpr float kHidden = 0.1f;     // Share of the values masked in training.
constexpr double kSparsity = 0.01;  // Weight of the hidden units' magnitude.

torch::Tensor hide(const torch::Tensor& rows, Random& random) {
  torch::Tensor mask = torch::empty_like(rows);
  float* m = mask.data_ptr<float>();
  for (int64_t i = 0; i < mask.numel(); ++i) m[i] = random.uniform() < kHidden ? 0.0f : 1.0f;
  return rows * mask;
}

}  // namespace

Autoencoder::Autoencoder(const Windows& windows, uint64_t seed,
                         const AutoencoderSettings& settings) {
  Random random(seed);
  encoder_ = Convolution(kRows, settings.units, &random);
  decoder_ = Convolution(settings.units, kRows, &random);
  learn({&encoder_, &decoder_}, settings.steps, kRate, [&](int) {
    const torch::Tensor rows = windows.draw(settings.batch, random);
    const torch::Tensor hidden = encode(hide(rows, random));
    return torch::mse_loss(decode(hidden), rows) + kSparsity * hidden.abs().mean();
  });
}

torch::Tensor Autoencoder::encode(const torch::Tensor& rows) const {
  return torch::max_pool1d(torch::relu(encoder_(rows)), 2);
}

torch::Tensor Autoencoder::decode(const torch::Tensor& hidden) const {
  return decoder_(torch::repeat_interleave(hidden, 2, 2));
}

torch::Tensor gram(const torch::Tensor& hidden) {
  return torch::bmm(hidden, hidden.transpose(1, 2)) / hidden.size(2);
}

}  // namespace panache::holden2017
