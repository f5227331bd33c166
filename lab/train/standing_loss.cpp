#include "train/styled_bodies.h"

#include "learn/take.h"
#include "pose/contacts.h"
#include "pose/features.h"
#include "train/classifier.h"

namespace panache {
namespace {

constexpr double kSpeedUnit = 0.2;  // m/s.
constexpr double kStands = 0.3;     // m/s: a faster toe is not planted.
constexpr double kLow = 0.05;       // Metres above the lowest toe of the sequence.
constexpr double kNoSpeed = 0.02;   // m/s.
// Free change of the distance between standing feet, metres, and the unit of the excess.
constexpr double kStance = 0.06, kStanceUnit = 0.1;
constexpr double kStep = kClassifiedSpacing / kTakeRate;  // Seconds between instants.

// Between neighbouring instants.
torch::Tensor halfway(const torch::Tensor& t) { return (t.slice(1, 1) + t.slice(1, 0, -1)) / 2; }

torch::Tensor toes_of(const torch::Tensor& bodies) {
  return torch::stack({bodies.select(2, index(kToes[0])), bodies.select(2, index(kToes[1]))}, 2);
}

// World velocities in the heading frame, m/s. [sequences][instants - 1][toes][3]
torch::Tensor velocities(const torch::Tensor& toes, const torch::Tensor& root) {
  const torch::Tensor position = halfway(toes), body = halfway(root).unsqueeze(2);
  const torch::Tensor own = (toes.slice(1, 1) - toes.slice(1, 0, -1)) / kStep;
  const torch::Tensor turn = body.select(3, kTurnRate);
  const torch::Tensor left =
      own.select(3, 0) + body.select(3, kVelocityLeft) + turn * position.select(3, 2);
  const torch::Tensor forward =
      own.select(3, 2) + body.select(3, kVelocityForward) - turn * position.select(3, 0);
  return torch::stack({left, own.select(3, 1), forward}, 3);
}

// Share of a sequence's movement that is forward or backward, 0 to 1. [sequences][1][1]
torch::Tensor travel(const torch::Tensor& root) {
  const torch::Tensor forward = root.select(2, kVelocityForward);
  const torch::Tensor speed =
      (forward.square() + root.select(2, kVelocityLeft).square() + 1e-8).sqrt().mean(1);
  return (forward.mean(1).abs() / (speed + kNoSpeed)).view({-1, 1, 1});
}

}  // namespace

torch::Tensor standing_loss(const torch::Tensor& in, const torch::Tensor& out,
                            const torch::Tensor& root, const torch::Tensor& root_change) {
  const torch::Tensor toes = toes_of(in);
  const torch::Tensor before = velocities(toes, root);
  const torch::Tensor after = velocities(toes_of(out), root + root_change * travel(root).square());
  const torch::Tensor height = halfway(toes).select(3, 1);
  const torch::Tensor low = height - height.amin({1, 2}, true) < kLow;
  const torch::Tensor stands = (1 - before.square().sum(3).sqrt() / kStands).relu() * low;
  const torch::Tensor moved = ((after - before).square().sum(3) + 1e-6).sqrt() / kSpeedUnit;
  // While both feet stand, they keep their stance: a body at rest does not get a walk's legs.
  const auto apart = [](const torch::Tensor& both) {
    const torch::Tensor between = halfway(both.select(2, 0) - both.select(2, 1));
    return torch::stack({between.select(2, 0), between.select(2, 2)}, 2);
  };
  const torch::Tensor stance =
      (((apart(toes_of(out)) - apart(toes)).square().sum(2) + 1e-6).sqrt() - kStance).relu() /
      kStanceUnit;
  const torch::Tensor rests = stands.prod(2);
  return (moved.square() / (1 + moved) * stands).sum() / (stands.sum() + 1e-5) +
         (stance.square() / (1 + stance) * rests).sum() / (rests.sum() + 1e-5);
}

}  // namespace panache
