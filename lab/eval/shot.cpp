#include "eval/shot.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "pose/contacts.h"
#include "pose/limb.h"
#include "takes/load_takes.h"

namespace panache {
namespace {

using enum HumanJoint;

// In metres and seconds of the canonical body, whose hips are at 0.9 m.
constexpr int kNear = 5;  // Frames before and after in which resting joints do not move.
constexpr float kRest = 0.02f;
constexpr float kFloor = 0.05f;      // A lower toe is on the floor.
constexpr float kTravel = 0.5f;      // m/s: faster hips travel.
constexpr float kSlowToe = 0.3f;     // m/s: a slower toe is planted.
constexpr float kSeat = 0.6f;        // Hips that rest lower sit, crouch or kneel.
constexpr float kBeyondFeet = 0.2f;  // Hips that rest further from the feet are held elsewhere.
constexpr float kHandsMeet = 0.18f, kHandAtHead = 0.28f;
constexpr float kThigh = 0.06f, kShin = 0.04f, kTorso = 0.11f, kForearm = 0.035f, kSkull = 0.09f;

using Body = HumanPositions;

// Whether a joint moves by less than kRest around a frame.
bool rests(const std::vector<Body>& world, int f, HumanJoint joint) {
  const int last = static_cast<int>(world.size()) - 1;
  const Vec3 here = world[f][index(joint)];
  for (int i = std::max(0, f - kNear); i <= std::min(last, f + kNear); ++i) {
    if (length(world[i][index(joint)] - here) > kRest) return false;
  }
  return true;
}

// Horizontal speed since the previous frame, m/s.
float speed_of(const std::vector<Body>& world, int f, HumanJoint joint) {
  const Vec3 step = world[f][index(joint)] - world[f - 1][index(joint)];
  return std::hypot(step.x, step.z) * static_cast<float>(kTakeRate);
}

float beyond_feet(const Body& body) {
  Vec3 feet{};
  for (const HumanJoint joint : {kAnkles[0], kAnkles[1], kToes[0], kToes[1]}) {
    feet += body[index(joint)] * 0.25f;
  }
  const Vec3 offset = body[index(hips)] - feet;
  return std::hypot(offset.x, offset.z);
}

float turn_deg(const Body& from, const Body& to, int side) {
  const auto heading = [&](const Body& body) {
    const Vec3 foot = body[index(kToes[side])] - body[index(kAnkles[side])];
    return std::atan2(foot.x, foot.z);
  };
  const double turn = static_cast<double>(heading(to)) - heading(from);
  return static_cast<float>(std::abs(std::remainder(turn, 2 * std::numbers::pi)) * 180 /
                            std::numbers::pi);
}

// The distance of two segments, sampled; metres.
float distance(Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
  constexpr int kSamples = 16;
  float min = length(from_line(a, c, d));
  for (int i = 1; i <= kSamples; ++i) {
    min = std::min(min, length(from_line(lerp(a, b, static_cast<float>(i) / kSamples), c, d)));
  }
  return min;
}

// The penetration depth of each pair of capsules, metres; negative if they are apart.
std::array<float, 6> depths_of(const Body& body) {
  const auto at = [&](HumanJoint joint) { return body[index(joint)]; };
  const auto thigh = [&](int side) {
    return lerp(at(kUpperLegs[side]), at(kLowerLegs[side]), 0.3f);
  };
  const Vec3 waist = (at(left_upper_leg) + at(right_upper_leg)) * 0.5f;
  const Vec3 shoulders = (at(left_upper_arm) + at(right_upper_arm)) * 0.5f;
  const Vec3 crown = at(head) + normalized(at(head) - at(neck)) * 0.09f;
  std::array<float, 6> depths = {
      2 * kThigh - distance(thigh(0), at(kLowerLegs[0]), thigh(1), at(kLowerLegs[1])),
      2 * kShin - distance(at(kLowerLegs[0]), at(kAnkles[0]), at(kLowerLegs[1]), at(kAnkles[1]))};
  for (int side = 0; side < 2; ++side) {
    const Vec3 wrist = at(kHands[side]);
    depths[2 + side] = kTorso + kForearm -
                       distance(lerp(at(kLowerArms[side]), wrist, 0.3f), wrist, waist,
                                lerp(waist, shoulders, 0.85f));
    depths[4 + side] = kSkull + kForearm - length(from_line(wrist, at(head), crown));
  }
  return depths;
}

}  // namespace

ShotValues measure_shot(const Take& input, const Take& output) {
  ShotValues values;
  const auto add = [&](ShotMeasure measure, float value) {
    values[static_cast<size_t>(measure)].push_back(value);
  };
  std::vector<Body> from, to;
  for (int f = 0; f < input.frames(); ++f) {
    from.push_back(world_positions(input, f));
    to.push_back(world_positions(output, f));
  }
  for (int f = 1; f < input.frames(); ++f) {
    const Body &was = from[f], &is = to[f];
    const auto change = [&](HumanJoint joint) {
      return 100 * (is[index(joint)].y - was[index(joint)].y);
    };
    const auto between = [&](HumanJoint a, HumanJoint b, float max, ShotMeasure measure) {
      const float near = length(was[index(a)] - was[index(b)]);
      if (near < max) add(measure, 100 * std::abs(length(is[index(a)] - is[index(b)]) - near));
    };
    const bool hips_rest = rests(from, f, hips);
    const bool seated = hips_rest && (was[index(hips)].y < kSeat || beyond_feet(was) > kBeyondFeet);
    const bool travels = speed_of(from, f, hips) > kTravel;
    if (seated) add(ShotMeasure::seat_hips, std::abs(change(hips)));
    for (int side = 0; side < kFeet; ++side) {
      const HumanJoint toe = kToes[side], ankle = kAnkles[side];
      if (was[index(toe)].y > kFloor) continue;
      const float off = std::abs(change(toe));
      if (seated) add(ShotMeasure::seat_toe, off);
      if (travels && speed_of(from, f, toe) < kSlowToe) add(ShotMeasure::walking_toe, off);
      if (!hips_rest || seated || !rests(from, f, toe) || !rests(from, f, ankle)) continue;
      add(ShotMeasure::standing_toe, off);
      add(ShotMeasure::standing_lift, std::max(0.0f, change(ankle)));
      add(ShotMeasure::standing_turn, turn_deg(was, is, side));
    }
    between(kHands[0], kHands[1], kHandsMeet, ShotMeasure::hands);
    for (const HumanJoint hand : kHands) between(hand, head, kHandAtHead, ShotMeasure::hand_head);
    const auto before = depths_of(was), after = depths_of(is);
    float deeper = 0;
    for (size_t i = 0; i < after.size(); ++i) {
      deeper = std::max(deeper, after[i] - std::max(0.0f, before[i]));
    }
    add(ShotMeasure::in_body, 100 * deeper);
  }
  return values;
}

}  // namespace panache
