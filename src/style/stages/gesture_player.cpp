#include "style/stages/gesture_player.h"

#include <algorithm>

#include "base/elementary.h"
#include "pose/limb.h"
#include "pose/changed_joints.h"
#include "style/stages/strengths.h"

namespace panache {
namespace {

constexpr float kOff = 1e-3f;  // Weaker styles have no gestures.

// The amount of a style's gestures.
float share_of(float strength) { return std::max(0.0f, movement_strength(strength)); }

// As StyleNetworks mixes a style and its mirror image.
GesturePose on_side(float side, const GesturePose& pose) {
  if (side == 1) return pose;
  GesturePose sum = scaled((1 + side) / 2, pose);
  add_scaled((1 - side) / 2, mirrored(pose), sum);
  return sum;
}

}  // namespace

void GesturePlayer::trigger(int style, int gesture) noexcept {
  next_style_ = style;
  next_gesture_ = gesture;
  waited_ = 0;
}

void GesturePlayer::step(const Model& model, std::span<const float> strengths,
                         std::span<const float> sides, float often, const Ground& ground,
                         const StepTime& time) noexcept {
  const float seconds = time.first ? 0 : time.output;
  if (often > 0) draw(model, strengths, often, seconds);
  if (style_ >= 0) {
    time_ += seconds;
    if (time_ >= model.gestures(style_)[gesture_].seconds()) style_ = -1;
  }
  if (style_ < 0 && next_style_ >= 0) start(model, strengths, ground, seconds);
  pose_ = {};
  if (style_ < 0) return;
  const Gesture& gesture = model.gestures(style_)[gesture_];
  const float share = share_of(strengths[style_]) * (1 - ground.flight);
  pose_ = scaled(gesture.moves_hips() ? share * (1 - ground.run) : share,
                 on_side(sides[style_], gesture.at(time_)));
}

void GesturePlayer::draw(const Model& model, std::span<const float> strengths, float often,
                         float seconds) noexcept {
  const auto rate_of = [&](size_t style) {
    if (!(strengths[style] > kOff)) return 0.0f;
    return std::min(strengths[style], 1.0f) * model.gesture_rate(static_cast<int>(style));
  };
  float rate = 0;
  for (size_t style = 0; style < strengths.size(); ++style) rate += rate_of(style);
  if (rate == 0) return;
  // The first one comes as soon as to somebody who looks at any moment.
  if (due_ < 0) due_ = begun_ ? 0.5f + random_.uniform() : random_.uniform();
  begun_ = true;
  due_ -= std::min(often * rate, kMaxGestureRate) * seconds;
  if (due_ > 0 || !rests()) return;
  due_ = -1;
  float chosen = random_.uniform() * rate;
  for (size_t style = 0; style < strengths.size(); ++style) {
    const float own = rate_of(style);
    chosen -= own;
    if (own == 0 || chosen > 0) continue;
    const auto count = static_cast<uint32_t>(model.gestures(static_cast<int>(style)).size());
    return trigger(static_cast<int>(style), static_cast<int>(random_.below(count)));
  }
}

void GesturePlayer::start(const Model& model, std::span<const float> strengths,
                          const Ground& ground, float seconds) noexcept {
  waited_ += seconds;
  if (waited_ > kPatience || !(strengths[next_style_] > kOff)) {
    next_style_ = -1;
    return;
  }
  const bool needs_feet = model.gestures(next_style_)[next_gesture_].moves_hips();
  if (ground.flight > 0 || !ground.holds_body ||
      (needs_feet && !(ground.holds_feet && ground.run == 0)))
    return;
  style_ = next_style_;
  gesture_ = next_gesture_;
  time_ = 0;
  next_style_ = -1;
}

namespace {

constexpr float kLifted = 0.03f;     // Metres: a foot that is lifted by this is free.
constexpr float kFirmKnee = 0.05f;   // See bend_of(), metres.
constexpr float kLegReach = 0.985f;  // Maximum stretch, as a share of the leg's length.
constexpr float kSoftLimit = 0.02f;  // Metres over which the limit sets in.

// How far the hips must sink so that no leg stretches beyond kLegReach, or beyond its stretch
// without the gesture; softly. `before` and `joints`: without and with the gesture.
float drop_for_legs(const HumanPositions& before, const HumanPositions& joints, float raised) {
  float drop = 0;
  for (size_t f = 0; f < kFeet; ++f) {
    const LimbJoints leg = leg_joints(static_cast<int>(f));
    const float whole = length(before[leg.middle] - before[leg.root]) +
                        length(before[leg.end] - before[leg.middle]);
    const float longest = std::max(kLegReach * whole, length(before[leg.end] - before[leg.root]));
    const Vec3 leg_line = before[leg.end] - Vec3{0, raised, 0} - joints[leg.root];
    const float over = length(leg_line) - longest;
    if (over > 0) drop = std::max(drop, over * over / (over + kSoftLimit));
  }
  return drop;
}

}  // namespace

void add_gesture(const GesturePose& gesture, const Shape& shape, const HeadingBody& body,
                 BodyChange& change) noexcept {
  HumanPositions before, joints;
  changed_joints(body, change, before);
  // Rotations add up from the hips to the hands.
  std::array<Quat, kGestureJoints> turns;
  for (int j = 0; j < kGestureJoints; ++j) {
    const float weight = shape.regions[static_cast<size_t>(region_of(j))];
    const Quat own = exp_rotation(gesture.turns[static_cast<size_t>(j)] * weight);
    turns[j] = kHumanParent[j] < 0 ? own : normalized(turns[kHumanParent[j]] * own);
    change.rotations[j] = normalized(turns[j] * change.rotations[j]);
  }
  const float lift = gesture_lift(gesture, shape);
  float height = gesture.height * legs_of(shape);
  if (height == 0 && lift == 0 && gesture.turns[0] == Vec3{}) return;
  changed_joints(body, change, joints);
  height -= drop_for_legs(before, joints, height - lift);
  change.translation.y += height;
  for (size_t f = 0; f < kFeet; ++f) {
    const LimbJoints leg = leg_joints(static_cast<int>(f));
    // Relative to the hips.
    const Vec3 target = before[leg.end] + Vec3{0, lift - height, 0};
    const Vec3 ahead = knee_direction(before[leg.end], before[index(kToes[f])]);
    turn_limb(leg, target,
              bend_of(before[leg.root], before[leg.middle], before[leg.end], ahead, kFirmKnee),
              joints, change);
  }
}

float gesture_lift(const GesturePose& gesture, const Shape& shape) noexcept {
  return gesture.lift * legs_of(shape);
}

float share_lifted(float lift) noexcept { return smooth_step(lift / kLifted); }

}  // namespace panache
