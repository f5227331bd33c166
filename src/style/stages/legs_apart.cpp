#include "style/stages/legs_apart.h"

#include <algorithm>
#include <cmath>

#include "base/elementary.h"
#include "pose/limb.h"

namespace panache {
namespace {

using enum HumanJoint;

// Radii of the canonical body, metres.
constexpr float kThigh = 0.064f, kShin = 0.044f;
// The upper share of the thighs, which are only as far apart as the hip joints.
constexpr float kCrotch = 0.3f;
constexpr int kPasses = 4;
// A leg of the input that is this far on its own side counts as being there, metres.
constexpr float kOwnSide = 0.02f;

// Points on thigh and shin that the other leg may push, from the upper to the lower joint.
constexpr std::array<std::array<float, 3>, 2> kPoints = {
    {{0.5f, 0.75f, 1}, {1.35f - 1, 1.7f - 1, 1}}};

// Thigh or shin.
struct Part {
  Vec3 from, to;
  float radius;
  Vec3 at(float share) const { return lerp(from, to, share); }
  // The part that the other leg may meet.
  Part below_crotch() const { return radius == kThigh ? Part{at(kCrotch), to, radius} : *this; }
};
Part part_of(const HumanPositions& joints, int side, size_t part) {
  const LimbJoints leg = leg_joints(side);
  return part == 0 ? Part{joints[leg.root], joints[leg.middle], kThigh}
                   : Part{joints[leg.middle], joints[leg.end], kShin};
}

// From the right to the left hip joint, unit.
Vec3 across_hips(const HumanPositions& joints) {
  return normalized(joints[index(left_upper_leg)] - joints[index(right_upper_leg)], {1, 0, 0});
}

// Standing legs do not pass each other, unlike stepping ones: of the vector between them only the
// component along the unit vector `out` counts.
Vec3 passing(Vec3 offset, Vec3 out, float stepping) {
  const Vec3 across = out * dot(offset, out);
  return across + (offset - across) * stepping;
}

// Whether parts of the left and the right leg may touch, measured by passing(). `left`: across the
// hips, unit.
bool may_meet(const Part& one, const Part& other, Vec3 left, float stepping) {
  // The gap between both parts along an axis.
  const auto beyond = [](const Part& a, const Part& b, Vec3 axis) {
    return std::min(dot(a.from, axis), dot(a.to, axis)) -
           std::max(dot(b.from, axis), dot(b.to, axis));
  };
  const float reach = one.radius + other.radius;
  if (beyond(one, other, left) > reach) return false;
  // At right angles to it; no longer than 1, so that no distance is overstated.
  const Vec3 ahead = {-left.z, 0, left.x};
  for (const Vec3 axis : {ahead, cross(ahead, left)}) {
    const float apart = std::max(beyond(one, other, axis), beyond(other, one, axis));
    if (stepping * apart > reach) return false;
  }
  return true;
}

// How far each point is pushed, metres.
using PartPushes = std::array<std::array<float, 3>, 2>;

// Raises the pushes of the leg of `side` by a part of the other leg. `out` and `own_side`: towards
// the leg's own side with the change and in the input, unit.
void raise_pushes(const HeadingBody& body, const HumanPositions& joints, int side, size_t own,
                  size_t other, Vec3 out, Vec3 own_side, float stepping, PartPushes& pushes) {
  const Part part = part_of(joints, side, own), input = part_of(body.joints, side, own);
  const Part there = part_of(joints, 1 - side, other).below_crotch();
  const Part before = part_of(body.joints, 1 - side, other).below_crotch();
  const float reach = part.radius + there.radius;
  for (size_t p = 0; p < kPoints[own].size(); ++p) {
    const float share = kPoints[own][p];
    const Vec3 point = part.at(share);
    const Vec3 offset = passing(from_line(point, there.from, there.to), out, stepping);
    float& push = pushes[own][p];
    if (!(push_across(offset, out, reach) > push)) continue;
    const Vec3 was =
        passing(from_line(input.at(share), before.from, before.to), own_side, stepping);
    const float kept =
        (std::min(reach, length(was)) - kFreeDepth) * smooth_step(dot(was, own_side) / kOwnSide);
    if (kept > 0) push = std::max(push, push_across(offset, out, kept));
  }
}

// The largest pushes of knee and ankle over the points of both legs, metres.
struct Pushes {
  float knee = 0, ankle = 0;
};
Pushes pushes_of(const HeadingBody& body, const HumanPositions& joints, float stepping) {
  const Vec3 left = across_hips(joints), left_before = across_hips(body.joints);
  PartPushes pushes{};
  for (size_t l = 0; l < 2; ++l) {
    for (size_t r = 0; r < 2; ++r) {
      if (!may_meet(part_of(joints, 0, l).below_crotch(), part_of(joints, 1, r).below_crotch(),
                    left, stepping)) {
        continue;
      }
      raise_pushes(body, joints, 0, l, r, left, left_before, stepping, pushes);
      raise_pushes(body, joints, 1, r, l, -left, -left_before, stepping, pushes);
    }
  }
  Pushes max;
  for (size_t p = 0; p < kPoints[0].size(); ++p) {
    max.knee = std::max(max.knee, pushes[0][p] / kPoints[0][p]);
  }
  for (size_t p = 0; p < kPoints[1].size(); ++p) {
    const float down = kPoints[1][p];
    max.ankle = std::max(max.ankle, (pushes[1][p] - max.knee * (1 - down)) / down);
  }
  return max;
}

// How a leg moves so that its knee goes out by `push.knee` and its ankle by `push.ankle` at least.
LimbMove move_of(const HumanPositions& joints, const LimbJoints& leg, Pushes push, Vec3 out,
                 float planted) {
  // A knee can swivel only as far as it is bent; the whole leg moves for the rest.
  const float bent = length(from_line(joints[leg.middle], joints[leg.root], joints[leg.end]));
  const float swivel = push.knee > 0 ? push.knee * bent / (bent + push.knee) : 0.0f;
  const float spread = std::max(push.ankle, 2 * (push.knee - swivel)) * (1 - planted);
  return {out * std::max(swivel, push.knee * planted), out * spread};
}

}  // namespace

void LegsApart::step(const HeadingBody& body, float amount, float stepping,
                     std::array<float, 2> planted, const StepTime& time, HumanPositions& joints,
                     BodyChange& change) noexcept {
  if (!(amount > 0)) return reset();
  HumanPositions moved = joints;
  bool pushed = false;
  for (int pass = 0; pass < kPasses; ++pass) {
    const Pushes pushes = pushes_of(body, moved, stepping);
    if (!(pushes.knee > 0 || pushes.ankle > 0)) break;
    pushed = true;
    const Vec3 left = across_hips(moved);
    for (int side = 0; side < 2; ++side) {
      const LimbJoints leg = leg_joints(side);
      const Pushes half = {pushes.knee / 2, pushes.ankle / 2};
      move_joints(leg, move_of(moved, leg, half, side == 0 ? left : -left, planted[side]), moved);
    }
  }
  if (move_eased({leg_joints(0), leg_joints(1)}, pushed ? &moved : nullptr, {amount, amount}, time,
                 moves_, joints, change)) {
    changed_legs(body, change, joints);
  }
}

}  // namespace panache
