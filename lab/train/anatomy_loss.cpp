#include "train/styled_bodies.h"

#include <numbers>
#include <vector>

#include "rig/beyond_range.h"
#include "rig/humanoid.h"

namespace panache {
namespace {

using enum HumanJoint;

constexpr double kUnit_deg = 10;
constexpr double kDegrees = 180 / std::numbers::pi;

// Keeps the square root differentiable at 0.
torch::Tensor root_of(const torch::Tensor& square) { return (square + 1e-8).sqrt(); }
// Dot products of rows. [rows][3] -> [rows]
torch::Tensor along(const torch::Tensor& a, const torch::Tensor& b) { return (a * b).sum(1); }
torch::Tensor unit(const torch::Tensor& v) { return v / root_of(along(v, v)).unsqueeze(1); }
torch::Tensor cross_of(const torch::Tensor& a, const torch::Tensor& b) {
  return torch::linalg_cross(a, b);
}

// As frame_of().
struct Frames {
  torch::Tensor x, y, z;  // [rows][3]
  torch::Tensor seen(const torch::Tensor& v) const {
    return torch::stack({along(v, x), along(v, y), along(v, z)}, 1);
  }
};
Frames frames_of(const torch::Tensor& left, const torch::Tensor& up) {
  const torch::Tensor x = unit(left), z = unit(cross_of(x, up));
  return {x, cross_of(z, x), z};
}

// How far directions (x out, y up, z ahead) swing beyond their range from `rest`, 1 (up) or -1.
torch::Tensor swing_beyond(const torch::Tensor& now, double rest, const SwingRange& range) {
  const torch::Tensor x = now.select(1, 0), y = now.select(1, 1), z = now.select(1, 2);
  const torch::Tensor across = root_of(x.square() + z.square());
  const auto share = [&](const torch::Tensor& v, float plus, float minus) {
    return (v.relu() / plus + (-v).relu() / minus) / across;
  };
  const torch::Tensor ahead = share(z, range.front, range.back),
                      side = share(x, range.out, range.in);
  const torch::Tensor max = 1 / root_of(ahead.square() + side.square());
  return kDegrees * torch::atan2(across, rest * y) - max;
}

// How far hinges between two limbs bend beyond their range. `ahead`: 1 if the lower limb bends
// forward, -1 if backward, with the upper one hanging down.
torch::Tensor hinge_beyond(const torch::Tensor& upper, const torch::Tensor& lower, float ahead,
                           const HingeRange& range) {
  const torch::Tensor down = torch::tensor({0.0f, -1.0f, 0.0f}).expand_as(upper);
  const torch::Tensor bends_to = torch::tensor({0.0f, 0.0f, ahead}).expand_as(upper);
  // Rotated as the upper limb is relative to hanging down.
  const torch::Tensor about = cross_of(down, upper), once = cross_of(about, bends_to);
  const torch::Tensor to =
      bends_to + once +
      cross_of(about, once) / (1 + along(down, upper)).clamp_min(0.1).unsqueeze(1);
  const torch::Tensor cosine = along(upper, lower);
  const torch::Tensor bend = lower - upper * cosine.unsqueeze(1);
  const torch::Tensor sine = root_of(along(bend, bend));
  const torch::Tensor angle = kDegrees * torch::atan2(sine, cosine);
  const torch::Tensor t =
      ((-along(bend, to) / sine - kWrongFrom) / (kWrongTo - kWrongFrom)).clamp(0, 1);
  const torch::Tensor wrong = angle * t * t * (3 - 2 * t);
  return torch::maximum(angle - range.max, wrong - range.back);
}

// Excess over the ranges of all ten joints, degrees. [rows][21][3] -> [rows][10]
torch::Tensor beyond_ranges(const torch::Tensor& bodies) {
  const auto at = [&](HumanJoint joint) { return bodies.select(1, index(joint)); };
  const auto direction = [&](HumanJoint from, HumanJoint to) { return unit(at(to) - at(from)); };
  const auto outward = [](const torch::Tensor& v, float side) {
    return v * torch::tensor({side, 1.0f, 1.0f});
  };
  const auto either_side = [](const torch::Tensor& v) {
    return torch::cat({v.slice(1, 0, 1).abs(), v.slice(1, 1)}, 1);
  };
  const torch::Tensor shoulders = (at(left_upper_arm) + at(right_upper_arm)) / 2;
  const Frames on_hips = frames_of(at(left_upper_leg) - at(right_upper_leg), at(spine) - at(hips));
  const Frames on_chest =
      frames_of(at(left_upper_arm) - at(right_upper_arm), shoulders - at(chest));

  std::vector<torch::Tensor> all = {
      swing_beyond(either_side(on_hips.seen(on_chest.y)), 1, kTorsoRange),
      swing_beyond(either_side(on_chest.seen(direction(neck, head))), 1, kHeadRange)};
  const auto add_arm = [&](float side, HumanJoint shoulder, HumanJoint elbow, HumanJoint hand) {
    const torch::Tensor upper = outward(on_chest.seen(direction(shoulder, elbow)), side);
    const torch::Tensor lower = outward(on_chest.seen(direction(elbow, hand)), side);
    const torch::Tensor overhead = kOverheadSlope * (kOverhead - upper.select(1, 1));
    all.push_back(torch::minimum(swing_beyond(upper, -1, kShoulderRange), overhead));
    // The twist of a raised arm is not observable.
    all.push_back(torch::minimum(hinge_beyond(upper, lower, 1, kElbowRange), overhead));
  };
  const auto add_leg = [&](float side, HumanJoint hip, HumanJoint knee, HumanJoint foot) {
    const torch::Tensor upper = outward(on_hips.seen(direction(hip, knee)), side);
    const torch::Tensor lower = outward(on_hips.seen(direction(knee, foot)), side);
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

torch::Tensor anatomy_loss(const torch::Tensor& in, const torch::Tensor& out) {
  const torch::Tensor allowed = beyond_ranges(in).clamp_min(0);
  const torch::Tensor over = ((beyond_ranges(out) - allowed) / kUnit_deg).relu();
  return (over.square() / (1 + over)).sum(1).mean();
}

}  // namespace panache
