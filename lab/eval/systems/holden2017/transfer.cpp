#include "eval/systems/holden2017/transfer.h"

namespace panache::holden2017 {
namespace {

constexpr double kRate = 1e-3;
constexpr int kStyleWindows = 64;  // Windows that an action's mean Gram matrix is made from.

// [windows][joints][3][frames], metres.
torch::Tensor positions(const torch::Tensor& rows) {
  return rows.narrow(1, 0, 3 * kHumanJoints).reshape({rows.size(0), kHumanJoints, 3, rows.size(2)});
}

// [windows][joints - 1][frames]
torch::Tensor bone_lengths(const torch::Tensor& joints) {
  const std::vector<int64_t> parents(kHumanParent.begin() + 1, kHumanParent.end());
  const torch::Tensor parent = joints.index_select(1, torch::tensor(parents));
  const torch::Tensor offset = joints.narrow(1, 1, kHumanJoints - 1) - parent;
  return (offset.square().sum(2) + 1e-8).sqrt();
}

// Squared ground speed of ankles and toes that are planted in the input: m^2/s^2.
torch::Tensor sliding(const torch::Tensor& rows, const torch::Tensor& planted) {
  const torch::Tensor joints = positions(rows);
  const int64_t frames = rows.size(2);
  const auto root = [&](int number) {
    return rows.select(1, root_offset(PoseLayout::positions) + number).narrow(1, 1, frames - 1);
  };
  torch::Tensor sum = torch::zeros({});
  for (int foot = 0; foot < kFeet; ++foot) {
    for (const HumanJoint joint : {kAnkles[foot], kToes[foot]}) {
      const torch::Tensor at = joints.select(1, index(joint));  // [windows][3][frames]
      const torch::Tensor now = at.narrow(2, 1, frames - 1);
      const torch::Tensor speed = (now - at.narrow(2, 0, frames - 1)) * kTakeRate;
      // In the body frame, which moves and turns: about +y, from z to x.
      const torch::Tensor x =
          speed.select(1, 0) + root(kVelocityLeft) + root(kTurnRate) * now.select(1, 2);
      const torch::Tensor z =
          speed.select(1, 2) + root(kVelocityForward) - root(kTurnRate) * now.select(1, 0);
      const torch::Tensor held = planted.select(1, foot).narrow(1, 1, frames - 1);
      sum = sum + (held * (x.square() + speed.select(1, 1).square() + z.square())).mean();
    }
  }
  return sum / (2 * kFeet);
}

}  // namespace

Transfer::Transfer(const Autoencoder& loss_network, const RowUnits& units,
                   const StyleMotion& motion, uint64_t seed, const TransferSettings& settings) {
  Random random(seed);
  first_ = Convolution(kRows, settings.units, &random);
  second_ = Convolution(settings.units, settings.units, &random);
  last_ = Convolution(settings.units, kRows, nullptr);  // Zero: initially outputs the input.

  // Neutral windows of all actions, with the target Gram matrix of each.
  std::vector<torch::Tensor> neutral, grams;
  double style_unit = 0;  // The loss of the unchanged input.
  std::vector<int> action_of;
  for (size_t a = 0; a < motion.actions.size(); ++a) {
    const StyleMotion::Action& action = motion.actions[a];
    const auto mean_gram = [&](const std::vector<torch::Tensor>& motions) {
      return gram(loss_network.encode(Windows(motions).draw(kStyleWindows, random))).mean(0);
    };
    grams.push_back(mean_gram(action.styled));
    style_unit += torch::mse_loss(mean_gram(action.neutral), grams.back()).item<double>() /
                  static_cast<double>(motion.actions.size());
    for (const torch::Tensor& rows : action.neutral) {
      neutral.push_back(rows);
      action_of.push_back(static_cast<int>(a));
    }
  }
  const Windows windows(neutral);
  std::vector<int> which;
  learn({&first_, &second_, &last_}, settings.steps, kRate, [&](int) {
    const torch::Tensor x = windows.draw(settings.batch, random, &which);
    std::vector<torch::Tensor> wanted;
    wanted.reserve(which.size());
    for (const int w : which) wanted.push_back(grams[action_of[w]]);
    const torch::Tensor y = (*this)(x);
    const torch::Tensor hidden = loss_network.encode(y), before = loss_network.encode(x);
    const torch::Tensor real = units.undo(y), real_before = units.undo(x);
    const torch::Tensor content = torch::mse_loss(hidden, before) / before.var();
    const torch::Tensor style = torch::mse_loss(gram(hidden), torch::stack(wanted)) / style_unit;
    const torch::Tensor bones =
        torch::mse_loss(bone_lengths(positions(real)), bone_lengths(positions(real_before)));
    const torch::Tensor feet = sliding(real, real_before.narrow(1, kPoseRows, kFeet));
    const torch::Tensor trajectory =
        torch::mse_loss(real.narrow(1, root_offset(PoseLayout::positions), kRootFeatures),
                        real_before.narrow(1, root_offset(PoseLayout::positions), kRootFeatures));
    const torch::Tensor change = positions(real) - positions(real_before);
    const torch::Tensor smooth = change.diff(2, 3).square().mean() * kTakeRate * kTakeRate;
    return settings.content * content + settings.style * style + settings.bones * bones +
           settings.feet * feet + settings.trajectory * trajectory + settings.smoothness * smooth;
  });
}

torch::Tensor Transfer::operator()(const torch::Tensor& rows) const {
  return rows + last_(torch::relu(second_(torch::relu(first_(rows)))));
}

size_t Transfer::parameters() const {
  return static_cast<size_t>(first_.parameters() + second_.parameters() + last_.parameters());
}

}  // namespace panache::holden2017
