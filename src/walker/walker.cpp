#include "walker/walker.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/vec.h"
#include "pose/contacts.h"
#include "rig/canonical_body.h"

namespace panache {
namespace {

// The walker has a fixed rate, so that the caller's makes no difference.
constexpr double kTick = 1.0 / 120;
constexpr double kLongestStep = 0.25;
// The gaits learnt their lean in turns at this speed.
constexpr float kLearntLeanSpeed = 1.05f;

// A gait faster than the learnt ones, or a mixture, may bend a knee the wrong way; limits it softly
// to almost straight.
float bent_knee(float bend) {
  constexpr float kSoft = 0.15f;  // Radians.
  return (bend + std::sqrt(bend * bend + kSoft * kSoft)) / 2;
}

constexpr float kDegree = std::numbers::pi_v<float> / 180;

// Channels of the driven joints that idle; each joint has x (nods), y (turns), z (tilts).
constexpr int kHips = 3, kSpine = 6, kChest = 9, kNeck = 12, kLeftShoulder = 15,
              kRightShoulder = 24;

// Adds breath, a wandering gaze and, while the body stands (`standing`, 0 to 1), shifts of weight.
// A function of time only.
void add_idle(double seconds, float standing, Channels& channels) noexcept {
  constexpr double turn = 2 * std::numbers::pi;
  const auto wave = [&](double hertz, double phase) {
    return static_cast<float>(std::sin(turn * std::fmod(hertz * seconds + phase, 1.0)));
  };
  // Fifteen breaths a minute lift ribs and shoulders; the head stays level.
  const float breath = wave(0.25, 0);
  channels[kChest] -= 0.7f * kDegree * breath;
  channels[kNeck] += 0.6f * kDegree * breath;
  channels[kLeftShoulder + 2] += 0.6f * kDegree * breath;
  channels[kRightShoulder + 2] -= 0.6f * kDegree * breath;
  // With incommensurable frequencies nothing repeats within a clip.
  channels[kNeck + 1] += kDegree * (1.6f * wave(0.071, 0.2) + 1.1f * wave(0.173, 0.6));
  channels[kNeck] += kDegree * 0.8f * wave(0.113, 0.4);
  channels[kChest + 1] += kDegree * 0.7f * wave(0.093, 0.1);

  // Weight to one side: the hips follow it and tilt, the spine stays upright.
  const float side = standing * (0.7f * wave(0.061, 0.05) + 0.3f * wave(0.147, 0.3));
  channels[0] += 0.018f * side;
  channels[1] -= 0.002f * side * side;
  channels[2] += 0.004f * standing * wave(0.197, 0.7);
  channels[kHips + 2] += 1.6f * kDegree * side;
  channels[kSpine + 2] -= 1.8f * kDegree * side;
}

float finite_or_zero(float x) { return std::isfinite(x) ? x : 0.0f; }

}  // namespace

Walker::Walker(std::shared_ptr<const WalkerModel> model) : model_(std::move(model)) {
  const Skeleton skeleton = canonical_skeleton();
  for (int j = 0; j < kHumanJoints; ++j) offsets_[j] = skeleton.joints[j].offset;
  reset();
}

void Walker::reset() noexcept {
  drive_ = {};
  feet_ = {};
  seconds_ = 0;
  ticks_ = 0;
  pose_body();
  pose_legs(static_cast<float>(kTick));
  before_ = now_;
}

RootPose Walker::root() const noexcept {
  return {{static_cast<float>(drive_.x()), 0, static_cast<float>(drive_.z())},
          static_cast<float>(drive_.heading())};
}

void Walker::step(float speed, float turn, double seconds, Pose out) noexcept {
  assert(out.rotations.size() == kHumanJoints && out.translations.size() == kHumanJoints);
  speed = std::clamp(finite_or_zero(speed), 0.0f, kMaxWalkerSpeed);
  turn = finite_or_zero(turn);
  seconds_ += std::isfinite(seconds) ? std::clamp(seconds, 0.0, kLongestStep) : 0.0;
  // A small tolerance for rounding in sums of 1/60 and similar.
  while (ticks_ * kTick < seconds_ - 1e-9) tick(speed, turn);
  const double behind = ticks_ - seconds_ / kTick;
  const float t = static_cast<float>(std::clamp(1 - behind, 0.0, 1.0));
  for (int j = 0; j < kHumanJoints; ++j) {
    out.rotations[j] = nlerp(before_.rotations[j], now_.rotations[j], t);
    out.translations[j] = offsets_[j];
  }
  out.translations[0] = lerp(before_.hips, now_.hips, t);
}

void Walker::tick(float speed, float turn) noexcept {
  before_ = now_;
  ++ticks_;
  drive_.tick(*model_, speed, turn, feet_.are_settled(), static_cast<float>(kTick));
  pose_body();
  pose_legs(static_cast<float>(kTick));
}

void Walker::pose_body() noexcept {
  Channels channels;
  drive_.channels(*model_, channels);
  const float standing = 1 - drive_.stepping();
  add_idle(ticks_ * kTick, standing * (1 - drive_.amount()), channels);
  // Small steps need the weight over the standing foot as much as large ones.
  const float shift = 0.025f * drive_.stepping() * (1 - drive_.amount());
  channels[0] += shift * std::cos(drive_.phase() - 1.66f);

  now_.rotations = {};
  for (size_t i = 0; i < kDriven.size(); ++i) {
    const float* r = &channels[3 + 3 * i];
    const bool is_knee =
        kDriven[i] == HumanJoint::left_lower_leg || kDriven[i] == HumanJoint::right_lower_leg;
    now_.rotations[index(kDriven[i])] =
        exp_rotation(Vec3{is_knee ? bent_knee(r[0]) : r[0], r[1], r[2]});
  }

  // The faster the turn, the further the whole body leans into it, about its path on the ground.
  const Going& going = drive_.going();
  const float lean = std::atan((going.speed - kLearntLeanSpeed * drive_.amount()) * going.turn /
                               static_cast<float>(kGravity));
  const Quat heading = rotation_y(static_cast<float>(drive_.heading()));
  const Quat frame = heading * axis_angle(Vec3{0, 0, 1}, -lean);
  up_ = rotate(frame, Vec3{0, 1, 0});
  now_.rotations[0] = normalized(frame * now_.rotations[0]);
  now_.hips = root().position + rotate(frame, Vec3{channels[0], channels[1], channels[2]});
  now_.hips.y -= feet_.drop();
}

void Walker::pose_legs(float dt) noexcept {
  Legs legs;
  const Quat hips = now_.rotations[0];
  for (int f = 0; f < kFeet; ++f) {
    const int upper = index(kUpperLegs[f]), lower = index(kLowerLegs[f]);
    const int foot = index(kAnkles[f]), toe = index(kToes[f]);
    Leg& leg = legs[f];
    leg.upper = hips * now_.rotations[upper];
    leg.lower = leg.upper * now_.rotations[lower];
    leg.foot = leg.lower * now_.rotations[foot];
    leg.hip = now_.hips + rotate(hips, offsets_[upper]);
    leg.knee = leg.hip + rotate(leg.upper, offsets_[lower]);
    leg.ankle = leg.knee + rotate(leg.lower, offsets_[foot]);
    leg.toe = leg.ankle + rotate(leg.foot, offsets_[toe]);
    leg.height = dot(leg.toe - root().position, up_);
  }
  const Steps steps = drive_.steps(*model_);
  const float lead = drive_.going().turn * steps.stance_seconds * (1 - drive_.amount());
  feet_.tick(drive_, steps, lead, dt, legs);
  for (int f = 0; f < kFeet; ++f) {
    const Leg& leg = legs[f];
    now_.rotations[index(kUpperLegs[f])] = normalized(conjugate(hips) * leg.upper);
    now_.rotations[index(kLowerLegs[f])] = normalized(conjugate(leg.upper) * leg.lower);
    now_.rotations[index(kAnkles[f])] = normalized(conjugate(leg.lower) * leg.foot);
  }
}

namespace {

// Standing time before the first step and after the last.
constexpr double kStandSeconds = 0.6;
// Maximum time to stop from any speed: the last seconds of a clip with a stop.
constexpr double kSecondsToStand = 2.2;

}  // namespace

Clip walk_clip(std::shared_ptr<const WalkerModel> model, const WalkClipOptions& options) {
  Clip clip;
  clip.skeleton = canonical_skeleton();
  clip.frame_time = 1 / options.fps;
  clip.resize(static_cast<int>(std::max(1.0, std::round(options.seconds * options.fps))));
  Walker walker(std::move(model));
  if (!options.start) {
    // Starts walking before the clip, so that it begins at full speed.
    std::array<Quat, kHumanJoints> rotations;
    std::array<Vec3, kHumanJoints> translations;
    for (int i = 0; i < 600; ++i) {
      walker.step(options.speed, options.turn, 1.0 / 60, {rotations, translations});
    }
  }
  const RootPose begin = walker.root();
  const Quat back = rotation_y(-begin.facing);
  const double stop_at = options.seconds - kSecondsToStand - options.speed / 2.5;
  for (int f = 0; f < clip.frames; ++f) {
    const double seconds = f * clip.frame_time;
    const bool goes =
        (!options.start || seconds >= kStandSeconds) && (!options.stop || seconds < stop_at);
    const Pose pose = clip.pose(f);
    walker.step(goes ? options.speed : 0, goes ? options.turn : 0, f ? clip.frame_time : 0, pose);
    pose.translations[0] = rotate(back, pose.translations[0] - begin.position);
    pose.rotations[0] = normalized(back * pose.rotations[0]);
  }
  return clip;
}

}  // namespace panache
