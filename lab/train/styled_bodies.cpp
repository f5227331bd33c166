#include "train/styled_bodies.h"

#include <numbers>
#include <vector>

#include "learn/take.h"
#include "pose/contacts.h"
#include "pose/features.h"
#include "rig/beyond_range.h"
#include "rig/humanoid.h"
#include "train/classifier.h"
#include "train/statistics_guide.h"

namespace panache {
namespace {

constexpr int kBones = kHumanJoints - 1;

// 1 if a bone is on the path from the hips to a joint. [21][20]
const torch::Tensor& bones_above() {
  static const torch::Tensor above = [] {
    torch::Tensor matrix = torch::zeros({kHumanJoints, kBones});
    for (int j = 1; j < kHumanJoints; ++j) {
      for (int bone = j; bone > 0; bone = kHumanParent[bone]) matrix[j][bone - 1] = 1;
    }
    return matrix;
  }();
  return above;
}

// Rotates vectors by rotation vectors (Rodrigues). [...][3]
torch::Tensor rotated(const torch::Tensor& rotation, const torch::Tensor& vector) {
  const torch::Tensor square = rotation.square().sum(-1, true) + 1e-8;
  const torch::Tensor angle = square.sqrt();
  const torch::Tensor once = torch::linalg_cross(rotation, vector);
  const torch::Tensor twice = torch::linalg_cross(rotation, once);
  return vector + angle.sin() / angle * once + (1 - angle.cos()) / square * twice;
}

}  // namespace

torch::Tensor styled_bodies(const torch::Tensor& bodies, const torch::Tensor& changes) {
  // A change rotates the bones below a joint, and lifts the hips.
  const int64_t rows = bodies.size(0);
  const torch::Tensor bones = bodies.slice(1, 1) - bodies.index_select(1, bone_parents());
  const torch::Tensor rotations = changes.slice(1, 0, kHipsHeight)
                                      .reshape({rows, kHumanJoints, 3})
                                      .index_select(1, bone_parents());
  const torch::Tensor nothing = torch::zeros({rows, 1});
  const torch::Tensor lift =
      torch::cat({nothing, changes.slice(1, kHipsHeight, kHipsHeight + 1), nothing}, 1);
  return (bodies.select(1, 0) + lift).unsqueeze(1) +
         torch::matmul(bones_above(), rotated(rotations, bones));
}

namespace {

constexpr double kUnit = 0.2;      // m/s.
constexpr double kStands = 0.3;    // m/s: a faster toe is not planted.
constexpr double kLow = 0.05;      // Metres above the lowest toe of the sequence.
constexpr double kNoSpeed = 0.02;  // m/s.
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
  const torch::Tensor place = halfway(toes), body = halfway(root).unsqueeze(2);
  const torch::Tensor own = (toes.slice(1, 1) - toes.slice(1, 0, -1)) / kStep;
  const torch::Tensor turn = body.select(3, kTurnRate);
  const torch::Tensor left =
      own.select(3, 0) + body.select(3, kVelocityLeft) + turn * place.select(3, 2);
  const torch::Tensor forward =
      own.select(3, 2) + body.select(3, kVelocityForward) - turn * place.select(3, 0);
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
  const torch::Tensor moved = ((after - before).square().sum(3) + 1e-6).sqrt() / kUnit;
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

namespace {

using enum HumanJoint;
using torch::Tensor;

constexpr double kUnit_deg = 10;
constexpr double kDegrees = 180 / std::numbers::pi;

// Keeps the square root differentiable at 0.
Tensor root_of(const Tensor& square) { return (square + 1e-8).sqrt(); }
// Dot products of rows. [rows][3] -> [rows]
Tensor along(const Tensor& a, const Tensor& b) { return (a * b).sum(1); }
Tensor unit(const Tensor& v) { return v / root_of(along(v, v)).unsqueeze(1); }
Tensor cross_of(const Tensor& a, const Tensor& b) { return torch::linalg_cross(a, b); }

// As frame_of().
struct Frames {
  Tensor x, y, z;  // [rows][3]
  Tensor seen(const Tensor& v) const {
    return torch::stack({along(v, x), along(v, y), along(v, z)}, 1);
  }
};
Frames frames_of(const Tensor& left, const Tensor& up) {
  const Tensor x = unit(left), z = unit(cross_of(x, up));
  return {x, cross_of(z, x), z};
}

// How far directions (x out, y up, z ahead) swing beyond their range from `rest`, 1 (up) or -1.
Tensor swing_beyond(const Tensor& now, double rest, const SwingRange& range) {
  const Tensor x = now.select(1, 0), y = now.select(1, 1), z = now.select(1, 2);
  const Tensor across = root_of(x.square() + z.square());
  const auto share = [&](const Tensor& v, float plus, float minus) {
    return (v.relu() / plus + (-v).relu() / minus) / across;
  };
  const Tensor ahead = share(z, range.front, range.back), side = share(x, range.out, range.in);
  const Tensor max = 1 / root_of(ahead.square() + side.square());
  return kDegrees * torch::atan2(across, rest * y) - max;
}

// How far hinges between two limbs bend beyond their range. `ahead`: 1 if the lower limb bends
// forward, -1 if backward, with the upper one hanging down.
Tensor hinge_beyond(const Tensor& upper, const Tensor& lower, float ahead,
                    const HingeRange& range) {
  const Tensor down = torch::tensor({0.0f, -1.0f, 0.0f}).expand_as(upper);
  const Tensor bends_to = torch::tensor({0.0f, 0.0f, ahead}).expand_as(upper);
  // Rotated as the upper limb is relative to hanging down.
  const Tensor about = cross_of(down, upper), once = cross_of(about, bends_to);
  const Tensor to = bends_to + once +
                    cross_of(about, once) / (1 + along(down, upper)).clamp_min(0.1).unsqueeze(1);
  const Tensor cosine = along(upper, lower);
  const Tensor bend = lower - upper * cosine.unsqueeze(1);
  const Tensor sine = root_of(along(bend, bend));
  const Tensor angle = kDegrees * torch::atan2(sine, cosine);
  const Tensor t = ((-along(bend, to) / sine - kWrongFrom) / (kWrongTo - kWrongFrom)).clamp(0, 1);
  const Tensor wrong = angle * t * t * (3 - 2 * t);
  return torch::maximum(angle - range.max, wrong - range.back);
}

// Excess over the ranges of all ten joints, degrees. [rows][21][3] -> [rows][10]
Tensor beyond_ranges(const Tensor& bodies) {
  const auto at = [&](HumanJoint joint) { return bodies.select(1, index(joint)); };
  const auto way = [&](HumanJoint from, HumanJoint to) { return unit(at(to) - at(from)); };
  const auto outward = [](const Tensor& v, float side) {
    return v * torch::tensor({side, 1.0f, 1.0f});
  };
  const auto either_side = [](const Tensor& v) {
    return torch::cat({v.slice(1, 0, 1).abs(), v.slice(1, 1)}, 1);
  };
  const Tensor shoulders = (at(left_upper_arm) + at(right_upper_arm)) / 2;
  const Frames on_hips = frames_of(at(left_upper_leg) - at(right_upper_leg), at(spine) - at(hips));
  const Frames on_chest =
      frames_of(at(left_upper_arm) - at(right_upper_arm), shoulders - at(chest));

  std::vector<Tensor> all = {
      swing_beyond(either_side(on_hips.seen(on_chest.y)), 1, kTorsoRange),
      swing_beyond(either_side(on_chest.seen(way(neck, head))), 1, kHeadRange)};
  const auto add_arm = [&](float side, HumanJoint shoulder, HumanJoint elbow, HumanJoint hand) {
    const Tensor upper = outward(on_chest.seen(way(shoulder, elbow)), side);
    const Tensor lower = outward(on_chest.seen(way(elbow, hand)), side);
    const Tensor overhead = kOverheadSlope * (kOverhead - upper.select(1, 1));
    all.push_back(torch::minimum(swing_beyond(upper, -1, kShoulderRange), overhead));
    // The twist of a raised arm is not observable.
    all.push_back(torch::minimum(hinge_beyond(upper, lower, 1, kElbowRange), overhead));
  };
  const auto add_leg = [&](float side, HumanJoint hip, HumanJoint knee, HumanJoint foot) {
    const Tensor upper = outward(on_hips.seen(way(hip, knee)), side);
    const Tensor lower = outward(on_hips.seen(way(knee, foot)), side);
    all.push_back(swing_beyond(upper, -1, kHipRange));
    all.push_back(hinge_beyond(upper, lower, -1, kKneeRange));
  };
  add_arm(1, left_upper_arm, left_lower_arm, left_hand);
  add_arm(-1, right_upper_arm, right_lower_arm, right_hand);
  add_leg(1, left_upper_leg, left_lower_leg, left_foot);
  add_leg(-1, right_upper_leg, right_lower_leg, right_foot);
  return torch::stack(all, 1);
}

}  // namespace

Tensor anatomy_loss(const Tensor& in, const Tensor& out) {
  const Tensor allowed = beyond_ranges(in).clamp_min(0);
  const Tensor over = ((beyond_ranges(out) - allowed) / kUnit_deg).relu();
  return (over.square() / (1 + over)).sum(1).mean();
}

namespace {

constexpr int64_t kBody = 3 * kHumanJoints;  // The first features of a window: the current pose.
constexpr float kUnit = 0.1f;                // Metres.

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
  return ((made - shown) / kUnit).square().sum(2).mean();
}

}  // namespace panache
