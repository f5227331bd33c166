#include "style/stages/legs_apart.h"

#include <cmath>

#include "base/smooth_step.h"
#include "pose/limb.h"
#include "pose/changed_joints.h"

namespace panache {
namespace {

using enum HumanJoint;

// Radii of the canonical body, metres.
constexpr float kThigh = 0.064f, kShin = 0.044f;
// Where thighs are only as far apart as the hips are wide, as a share of their length.
constexpr float kCrotch = 0.3f;
constexpr int kPasses = 4;
// A leg of the input that is this far on its own side counts as being there, metres.
constexpr float kOwnSide = 0.02f;

// A point of a leg: 0 to 1 from hip to knee, 1 to 2 from there to the ankle.
struct LegPoint {
  float place, radius;
};
constexpr std::array<LegPoint, 6> kLegPoints = {
    {{0.5f, kThigh}, {0.75f, kThigh}, {1, kThigh}, {1.35f, kShin}, {1.7f, kShin}, {2, kShin}}};

Vec3 point_of(const HumanPositions& joints, const LimbJoints& leg, float place) {
  return place <= 1 ? lerp(joints[leg.root], joints[leg.middle], place)
                    : lerp(joints[leg.middle], joints[leg.end], place - 1);
}
// From a part of a leg (0 thigh, 1 shin) to a point.
Vec3 from_part(const HumanPositions& joints, const LimbJoints& leg, int part, Vec3 point) {
  const Vec3 knee = joints[leg.middle];
  return part == 0 ? from_line(point, lerp(joints[leg.root], knee, kCrotch), knee)
                   : from_line(point, knee, joints[leg.end]);
}

// From the right to the left hip joint, unit.
Vec3 across_hips(const HumanPositions& joints) {
  return normalized(joints[index(left_upper_leg)] - joints[index(right_upper_leg)], {1, 0, 0});
}

// Whether no part of a leg comes as near to the other, across the hips, as both are thick.
bool are_apart(const HumanPositions& joints) {
  const Vec3 left = across_hips(joints);
  // Thigh and shin, each leg's innermost place towards the other.
  std::array<std::array<float, 2>, 2> inner;
  for (int side = 0; side < 2; ++side) {
    const LimbJoints leg = leg_joints(side);
    const float own = side == 0 ? 1.0f : -1.0f;
    const float hip = own * dot(joints[leg.root], left);
    const float knee = own * dot(joints[leg.middle], left);
    inner[side] = {std::min(hip + kCrotch * (knee - hip), knee),
                   std::min(knee, own * dot(joints[leg.end], left))};
  }
  constexpr std::array<float, 2> kThick = {kThigh, kShin};
  for (size_t a = 0; a < 2; ++a) {
    for (size_t b = 0; b < 2; ++b) {
      if (inner[0][a] + inner[1][b] < kThick[a] + kThick[b]) return false;
    }
  }
  return true;
}

// Legs that stand do not pass each other, as steps do: of the way from one to the other only what
// is along the unit vector `out` counts.
Vec3 passing(Vec3 way, Vec3 out, float stepping) {
  const Vec3 across = out * dot(way, out);
  return across + (way - across) * stepping;
}

// The furthest pushes of knee and ankle that the points of both legs ask for, metres.
struct Pushes {
  float knee = 0, ankle = 0;
};
Pushes pushes_of(const BodyPose& body, const HumanPositions& joints, float stepping) {
  std::array<float, kLegPoints.size()> pushes{};
  const Vec3 left = across_hips(joints);
  for (int side = 0; side < 2; ++side) {
    const LimbJoints leg = leg_joints(side), other = leg_joints(1 - side);
    const Vec3 out = side == 0 ? left : -left;
    for (size_t p = 0; p < kLegPoints.size(); ++p) {
      const auto [place, radius] = kLegPoints[p];
      const Vec3 point = point_of(joints, leg, place);
      for (int part = 0; part < 2; ++part) {
        const float reach = radius + (part == 0 ? kThigh : kShin);
        const Vec3 way = passing(from_part(joints, other, part, point), out, stepping);
        if (!(push_across(way, out, reach) > pushes[p])) continue;
        const Vec3 own_side = across_hips(body.joints) * (side == 0 ? 1.0f : -1.0f);
        const Vec3 was =
            passing(from_part(body.joints, other, part, point_of(body.joints, leg, place)),
                    own_side, stepping);
        const float own = dot(was, own_side);
        const float kept =
            (std::min(reach, length(was)) - kFreeDepth) * smooth_step(own / kOwnSide);
        if (kept > 0) pushes[p] = std::max(pushes[p], push_across(way, out, kept));
      }
    }
  }
  Pushes most;
  for (size_t p = 0; p < kLegPoints.size(); ++p) {
    const float place = kLegPoints[p].place;
    if (place <= 1) most.knee = std::max(most.knee, pushes[p] / place);
  }
  for (size_t p = 0; p < kLegPoints.size(); ++p) {
    const float down = kLegPoints[p].place - 1;
    if (down <= 0) continue;
    most.ankle = std::max(most.ankle, (pushes[p] - most.knee * (1 - down)) / down);
  }
  return most;
}

// How a leg moves so that its knee goes out by `push.knee` and its ankle by `push.ankle` at least.
LimbMove move_of(const HumanPositions& joints, const LimbJoints& leg, Pushes push, Vec3 out,
                 float planted) {
  // A knee swivels by as much as it is bent; the rest is up to the whole leg.
  const float bent = length(from_line(joints[leg.middle], joints[leg.root], joints[leg.end]));
  const float swivel = push.knee > 0 ? push.knee * bent / (bent + push.knee) : 0.0f;
  const float spread = std::max(push.ankle, 2 * (push.knee - swivel)) * (1 - planted);
  return {out * std::max(swivel, push.knee * planted), out * spread};
}

}  // namespace

void LegsApart::step(const BodyPose& body, float amount, float stepping,
                     std::array<float, 2> planted, const StepTime& time, HumanPositions& joints,
                     BodyChange& change) noexcept {
  if (!(amount > 0)) return reset();
  if (moves_[0].rests() && moves_[1].rests() && are_apart(joints)) return;
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
    changed_joints(body, change, joints);
  }
}

}  // namespace panache
