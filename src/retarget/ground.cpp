#include "retarget/ground.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "base/elementary.h"
#include "pose/limb.h"
#include "pose/changed_joints.h"

namespace panache {
namespace {

// A foot counts less the higher it is: a third at 7 cm, a hundredth far up.
constexpr float kLow = 0.07f;
constexpr float kMinWeight = 0.01f;
// The body rises this long before a toe would go under the floor.
constexpr float kRiseSeconds = 0.12f;
// Time for a foot to blend to and from its planted position.
constexpr float kBlendSeconds = 0.25f;
// Plants with a shorter gap are merged.
constexpr float kGapSeconds = 0.07f;
// A nearly straight knee points where the foot does, see bend_of().
constexpr float kFirm = 0.05f, kFirmShift = 0.02f;

float weight(float height) {
  const float far = height / kLow;
  return exponential(-far * far);
}

Vec3 toe_position(const BodyPose& body, const HumanPositions& joints, const BodyChange& change,
                  int foot) {
  return mid_hip(body) + change.translation + joints[index(kToes[foot])];
}

void bend_leg(int foot, Vec3 shift, HumanPositions joints, BodyChange& change) {
  if (shift == Vec3{}) return;
  const LimbJoints leg = leg_joints(foot);
  const Vec3 ankle = joints[leg.end], ahead = knee_direction(ankle, joints[index(kToes[foot])]);
  const float firm = kFirm * std::min(1.0f, length(shift) / kFirmShift);
  const Vec3 bend = bend_of(joints[leg.root], joints[leg.middle], ankle, ahead, firm);
  turn_limb(leg, ankle + shift, bend, joints, change);
}

// A smooth curve that is at least `depths` everywhere.
std::vector<float> smooth_above(const std::vector<float>& depths, int reach) {
  const int count = static_cast<int>(depths.size());
  const auto window = [&](int f, const auto& take) {
    for (int i = std::max(f - reach, 0); i <= std::min(f + reach, count - 1); ++i) take(i);
  };
  std::vector<float> highest(depths.size()), out(depths.size());
  for (int f = 0; f < count; ++f) {
    window(f, [&](int i) { highest[f] = std::max(highest[f], depths[i]); });
  }
  for (int f = 0; f < count; ++f) {
    float sum = 0, weights = 0;
    window(f, [&](int i) {
      const float share = static_cast<float>(reach + 1 - std::abs(i - f));
      sum += share * highest[i];
      weights += share;
    });
    out[f] = sum / weights;
  }
  return out;
}

// An interval in which one foot is planted.
struct Plant {
  int first = 0, last = 0;
  Vec3 offset;  // Mean offset of the foot from the motion's; y = 0.
};

std::vector<Plant> find_plants(const std::vector<GroundedFrame>& frames,
                               const std::vector<Vec3>& toes, int foot, float seconds) {
  std::vector<Plant> plants;
  for (int f = 0; f < static_cast<int>(frames.size()); ++f) {
    if (!frames[f].contacts[foot]) continue;
    const bool goes_on =
        !plants.empty() && static_cast<float>(f - plants.back().last) * seconds <= kGapSeconds;
    if (goes_on) {
      plants.back().last = f;
    } else {
      plants.push_back({f, f, {}});
    }
  }
  for (Plant& plant : plants) {
    for (int f = plant.first; f <= plant.last; ++f) {
      plant.offset += toes[f] - frames[f].toes[foot];
    }
    plant.offset *= 1 / static_cast<float>(plant.last - plant.first + 1);
    plant.offset.y = 0;
  }
  return plants;
}

// How far a foot is blended to a plant that is `away` seconds off: 1 to 0.
float nearness(float away) { return smooth_step(1 - away / kBlendSeconds); }

// The shift of the foot in each frame. toes: [frames] its positions.
std::vector<Vec3> find_shifts(const std::vector<GroundedFrame>& frames,
                              const std::vector<Vec3>& toes, int foot, float seconds) {
  const std::vector<Plant> plants = find_plants(frames, toes, foot, seconds);
  std::vector<Vec3> shifts(frames.size());
  for (int f = 0; f < static_cast<int>(frames.size()); ++f) {
    float sum = 0;
    Vec3 shift;
    for (const Plant& plant : plants) {
      const int away = std::max({plant.first - f, f - plant.last, 0});
      const float near = nearness(static_cast<float>(away) * seconds);
      if (near <= 0) continue;
      Vec3 target = frames[f].toes[foot] + plant.offset;
      target.y = std::max(target.y, 0.0f);
      shift += (target - toes[f]) * near;
      sum += near;
    }
    shifts[f] = shift * (1 / std::max(sum, 1.0f));
    shifts[f].y += std::max(0.0f, -(toes[f].y + shifts[f].y));
  }
  return shifts;
}

// Moves the feet by `shifts`, with the body lifted by `lifts`; returns the remaining depth of the
// lowest toe in each frame. shifts: [feet][frames].
std::vector<float> place_feet(const HeadingBody& body, std::span<const std::vector<Vec3>> shifts,
                              const std::vector<float>& lifts, std::vector<GroundedFrame>& frames) {
  std::vector<float> depths;
  HumanPositions joints;
  for (size_t f = 0; f < frames.size(); ++f) {
    BodyChange& change = frames[f].change;
    changed_joints(body, change, joints);
    change.translation.y += lifts[f];
    for (int foot = 0; foot < kFeet; ++foot) {
      bend_leg(foot, shifts[foot][f] - Vec3{0, lifts[f], 0}, joints, change);
    }
    changed_joints(body, change, joints);
    depths.push_back(floor_depth(body, joints, change));
  }
  return depths;
}

}  // namespace

void match_heights(const BodyPose& body, GroundedFrame& frame) noexcept {
  HumanPositions joints;
  changed_joints(body, frame.change, joints);
  float sum = 0, weights = 0;
  for (int f = 0; f < kFeet; ++f) {
    const float share = kMinWeight + weight(frame.toes[f].y);
    sum += share * (frame.toes[f].y - toe_position(body, joints, frame.change, f).y);
    weights += share;
  }
  frame.change.translation.y += sum / weights;
}

void hold_feet(const HeadingBody& body, float seconds, std::vector<GroundedFrame>& frames) {
  std::array<std::vector<Vec3>, kFeet> toes, shifts;
  for (const GroundedFrame& frame : frames) {
    HumanPositions joints;
    changed_joints(body, frame.change, joints);
    for (int foot = 0; foot < kFeet; ++foot) {
      toes[foot].push_back(toe_position(body, joints, frame.change, foot));
    }
  }
  for (int foot = 0; foot < kFeet; ++foot) {
    shifts[foot] = find_shifts(frames, toes[foot], foot, seconds);
  }
  const std::vector<GroundedFrame> before = frames;
  std::vector<float> lifts(frames.size());
  const std::vector<float> depths = place_feet(body, shifts, lifts, frames);
  if (std::all_of(depths.begin(), depths.end(), [](float depth) { return depth <= 0; })) return;
  const int reach = std::max(1, static_cast<int>(std::lround(kRiseSeconds / seconds)));
  lifts = smooth_above(depths, reach);
  frames = before;
  const std::vector<float> left = place_feet(body, shifts, lifts, frames);
  for (size_t f = 0; f < frames.size(); ++f) frames[f].change.translation.y += left[f];
}

}  // namespace panache
