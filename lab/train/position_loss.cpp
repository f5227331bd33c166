#include "train/styled_bodies.h"

#include "rig/humanoid.h"

namespace panache {
namespace {

constexpr int64_t kBody = 3 * kHumanJoints;  // The first features of a window: the current pose.
constexpr float kPositionUnit = 0.1f;        // Metres.

}  // namespace

PositionLoss::PositionLoss(const SampleSet& set, const OutputUnits& units)
    : input_mean_(torch::tensor(set.mean()).slice(0, 0, kBody)),
      input_scale_(torch::tensor(set.scale()).slice(0, 0, kBody)),
      output_scale_(torch::tensor(units.scale)) {}

torch::Tensor PositionLoss::operator()(const torch::Tensor& answers, const Batch& batch) const {
  const torch::Tensor now = batch.inputs.slice(1, 0, kBody) * input_scale_ + input_mean_;
  const torch::Tensor bodies = now.view({-1, kHumanJoints, 3});
  const torch::Tensor made = styled_bodies(bodies, answers * output_scale_);
  const torch::Tensor shown = styled_bodies(bodies, batch.pose * output_scale_);
  return ((made - shown) / kPositionUnit).square().sum(2).mean();
}

}  // namespace panache
