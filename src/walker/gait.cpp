#include "walker/gait.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/quat.h"
#include "rig/canonical_body.h"

namespace panache {
namespace {

constexpr float kTurn = 2 * std::numbers::pi_v<float>;

// The data only cover turns up to 60 degrees a second.
constexpr float kMaxTurn = 1.3f;
constexpr float kMaxAcceleration = 0.7f;

// Beyond the speeds that a gait was learnt at, cadence follows this power of the speed, as it does
// in people who walk freely (Grieve 1968), and the steps take up the rest.
constexpr float kFreeExponent = 0.42f;

// From the hips to the left toes, at rest. Initialised at first use, after the skeleton.
const std::array<Vec3, 4>& left_leg() {
  static const std::array<Vec3, 4> offsets = [] {
    const Skeleton skeleton = canonical_skeleton();
    std::array<Vec3, 4> out;
    for (int i = 0; i < 4; ++i) {
      out[i] = skeleton.joints[index(HumanJoint::left_upper_leg) + i].offset;
    }
    return out;
  }();
  return offsets;
}

int slot_of(HumanJoint joint) {
  return static_cast<int>(std::find(kDriven.begin(), kDriven.end(), joint) - kDriven.begin());
}

Quat rotation_of(const Channels& channels, HumanJoint joint) {
  const float* r = &channels[3 + 3 * slot_of(joint)];
  return exp_rotation(Vec3{r[0], r[1], r[2]});
}

Vec3 left_toe(const Channels& channels) {
  const std::array<Vec3, 4>& leg = left_leg();
  Quat world = rotation_of(channels, HumanJoint::hips);
  Vec3 at = Vec3{channels[0], channels[1], channels[2]} + rotate(world, leg[0]);
  for (int i = 0; i < 3; ++i) {
    const auto joint = static_cast<HumanJoint>(index(HumanJoint::left_upper_leg) + i);
    world = world * rotation_of(channels, joint);
    at += rotate(world, leg[i + 1]);
  }
  return at;
}

}  // namespace

Channels mirrored(const Channels& channels) noexcept {
  Channels out;
  // A reflection in x = 0 negates a position's x, and the other two components of a rotation's
  // axis.
  out[0] = -channels[0];
  out[1] = channels[1];
  out[2] = channels[2];
  for (size_t i = 0; i < kDriven.size(); ++i) {
    const auto other = static_cast<HumanJoint>(kHumanMirror[index(kDriven[i])]);
    const float* from = &channels[3 + 3 * slot_of(other)];
    float* to = &out[3 + 3 * i];
    to[0] = from[0];
    to[1] = -from[1];
    to[2] = -from[2];
  }
  return out;
}

void gait_terms(const Gait& gait, const Going& going, std::span<float, kTerms> terms) noexcept {
  const float learnt = std::clamp(going.speed, gait.slowest, gait.fastest) - gait.reference;
  terms[0] = 1;
  terms[1] = going.speed - gait.reference;
  terms[2] = learnt * learnt;
  terms[3] = std::clamp(going.turn, -kMaxTurn, kMaxTurn);
  terms[4] = terms[3] * terms[3];
  terms[5] = std::clamp(going.acceleration, -kMaxAcceleration, kMaxAcceleration);
}

void gait_waves(float phase, std::span<float, kWaves> waves) noexcept {
  waves[0] = 1;
  const float c = std::cos(phase), s = std::sin(phase);
  waves[1] = c;
  waves[2] = s;
  for (int k = 3; k < kWaves; k += 2) {  // cos and sin of (n + 1) x from those of n x.
    waves[k] = waves[k - 2] * c - waves[k - 1] * s;
    waves[k + 1] = waves[k - 1] * c + waves[k - 2] * s;
  }
}

void evaluate(const Gait& gait, float phase, const Going& going, Channels& out) noexcept {
  std::array<float, kTerms> terms;
  std::array<float, kWaves> waves;
  gait_terms(gait, going, terms);
  gait_waves(phase, waves);
  std::array<float, size_t(kWaves) * kTerms> weights;
  for (int k = 0; k < kWaves; ++k) {
    for (int b = 0; b < kTerms; ++b) weights[k * kTerms + b] = waves[k] * terms[b];
  }
  const float* coefficient = gait.coefficients.data();
  for (float& channel : out) {
    float sum = 0;
    for (const float weight : weights) sum += weight * *coefficient++;
    channel = sum;
  }
}

float cadence(const Gait& gait, float speed) noexcept {
  const float learnt = std::clamp(speed, gait.slowest, gait.fastest);
  return gait.cadence * std::pow(learnt, gait.exponent) *
         std::pow(std::max(speed, 1e-3f) / learnt, kFreeExponent);
}

float distance_over_foot(const Gait& gait, float speed) {
  constexpr float kFrom = 0.2f, kTo = 0.8f;  // Of the stance: the whole sole is down.
  const float stance = gait.lifts[0] - gait.lands[0];
  const auto toe_ahead = [&](float share) {
    Channels channels;
    evaluate(gait, gait.lands[0] + stance * share, {speed, 0, 0}, channels);
    return left_toe(channels).z;
  };
  return (toe_ahead(kFrom) - toe_ahead(kTo)) * kTurn / ((kTo - kFrom) * stance);
}

}  // namespace panache
