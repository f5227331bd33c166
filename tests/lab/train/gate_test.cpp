#include "train/fit_heads.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "base/random.h"
#include "make_model.h"
#include "style/networks/networks.h"

namespace panache {
namespace {

constexpr int kHidden = 16;

// Rows of a stretched normal cloud around `centre`: column i has the deviation 1 + i / 4.
torch::Tensor cloud(int64_t rows, float size, float centre, uint64_t seed) {
  torch::Tensor tensor = torch::empty({rows, kHidden});
  Random random(seed);
  for (int64_t i = 0; i < tensor.numel(); ++i) {
    const float deviation = 1 + 0.25f * static_cast<float>(i % kHidden);
    tensor.data_ptr<float>()[i] = centre + size * deviation * random.normal();
  }
  return tensor;
}

torch::Tensor read(const TensorFile& file, const std::string& name) {
  const Tensor& tensor = file.tensors.at(name);
  return torch::tensor(tensor.values).view(tensor.shape);
}

// Distance of each row as the program will measure it.
torch::Tensor distances(const TensorFile& file, const torch::Tensor& rows) {
  const torch::Tensor centred = rows - read(file, "gate.mean");
  return torch::mm(centred, read(file, "gate.whitening.weight")).square().sum(1).sqrt();
}

// The limit as a share of the distance that 99 % of the rows keep.
double trusted_share(const torch::Tensor& rows) {
  TensorFile file;
  fit_gate(rows, file);
  return file.tensors.at("gate.limit").values[0] /
         distances(file, rows).quantile(0.99).item<double>();
}

TEST(FitGate, the_mean_and_the_spread_of_the_rows_are_taken_out) {
  const torch::Tensor rows = cloud(4000, 0.7f, 3, 1);
  TensorFile file;
  fit_gate(rows, file);
  EXPECT_LT((read(file, "gate.mean") - rows.mean(0)).abs().max().item<float>(), 1e-4f);
  const torch::Tensor white = torch::mm(rows - rows.mean(0), read(file, "gate.whitening.weight"));
  const torch::Tensor covariance = torch::mm(white.t(), white) / 3999;
  // The ridge, a fiftieth of the mean variance (9.1), takes at most a fifth of the least (1) and
  // the weights are 16-bit floats.
  const torch::Tensor spread = covariance.diagonal();
  EXPECT_LT(spread.max().item<float>(), 1.002f);
  EXPECT_GT(spread.min().item<float>(), 0.78f);
  EXPECT_LT((covariance - torch::diag(spread)).abs().max().item<float>(), 5e-3f);
}

TEST(FitGate, the_limit_is_the_same_share_of_the_distance_of_99_in_100_for_every_cloud) {
  const double share = trusted_share(cloud(4000, 1, 0, 1));
  EXPECT_GT(share, 0.4);
  EXPECT_LT(share, 1.5);
  // Weights of 11 binary digits.
  EXPECT_NEAR(trusted_share(cloud(4000, 20, -5, 2)), share, 2e-3);
  EXPECT_NEAR(trusted_share(cloud(500, 0.01f, 1, 3)), share, 2e-3);
  torch::Tensor outlying = cloud(4000, 1, 0, 1);
  outlying[0] += 1e2;  // One odd row of 4000 is not what the limit is for.
  EXPECT_NEAR(trusted_share(outlying), share, 2e-3);
}

TEST(FitGate, directions_without_any_variation_are_no_reason_to_distrust) {
  torch::Tensor rows = cloud(1000, 1, 0, 1);
  rows.select(1, 4).fill_(2);
  TensorFile file;
  fit_gate(rows, file);
  EXPECT_TRUE(torch::isfinite(read(file, "gate.whitening.weight")).all().item<bool>());
  torch::Tensor near = rows.slice(0, 0, 1).clone();
  const float before = distances(file, near).item<float>();
  near[0][4] += 0.05f;  // A tenth of the ridge's deviation.
  EXPECT_LT(std::abs(distances(file, near).item<float>() - before), 0.15f);
}

TEST(FitGate, a_model_with_it_trusts_the_middle_of_the_cloud_and_not_what_is_far) {
  TensorFile file = test::make_model({"old"});
  // Without weights the trunk answers with its last bias: the feature itself, above -1.
  for (const char* name : {"pose.trunk.0.weight", "pose.trunk.1.weight"}) {
    for (float& w : file.tensors[name].values) w = 0;
  }
  fit_gate(cloud(4000, 0.3f, 4, 1), file);
  const auto gate_at = [&](float feature) {
    file.tensors["pose.trunk.1.bias"] = test::constant_tensor(kHidden, feature);
    StyleNetworks networks(*Model::parse(format_safetensors(file), "test model"));
    networks.set_strengths(std::vector<float>{1});
    networks.forward(std::vector<float>(size_t(kWindowPoses) * 66, 0.0f));
    return networks.gate();
  };
  EXPECT_EQ(gate_at(4), 1);
  EXPECT_EQ(gate_at(4.2f), 1);
  EXPECT_LT(gate_at(40), 1e-3f);
}

}  // namespace
}  // namespace panache
