#include "character.h"

#include <algorithm>
#include <cmath>

#include "base/elementary.h"

namespace panache::web {
namespace {

constexpr float kEaseSeconds = StylizerOptions{}.ease_seconds;
// Long enough for a cycle of two steps to cancel out of the mean, mostly.
constexpr float kPostureSeconds = 0.8f;
constexpr float kLiftSeconds = 0.1f;  // As the stylizer's own.
// At twice what a style asks for, a rate would leave what the stylizer itself allows.
constexpr double kMaxLogRate = 0.7;

float filter_gain(float seconds, float time_constant) {
  return 1 - exponential(-seconds / time_constant);
}

// Goes this share of the way and, in the end, all of it.
void approach(float& value, float target, float share) {
  value += share * (target - value);
  if (std::abs(target - value) < 1e-4f) value = target;
}

float bounded(float amount) { return std::isfinite(amount) ? std::clamp(amount, 0.0f, 2.0f) : 1; }

constexpr Region region_of(int joint) {
  using enum HumanJoint;
  if (joint == index(hips) || joint >= index(left_upper_leg)) return kLegs;
  if (joint <= index(chest)) return kSpine;
  return joint <= index(head) ? kHead : kArms;
}

}  // namespace

Result<Character> Character::create(std::shared_ptr<const Model> model, const Rig& rig) {
  StylizerOptions options;
  options.ease_seconds = 0;
  options.foot_lock = false;
  Result<Stylizer> stylizer = Stylizer::create(std::move(model), rig, options);
  if (!stylizer) return stylizer.error();
  return Character(*std::move(stylizer), rig);
}

Character::Character(Stylizer stylizer, const Rig& rig)
    : stylizer_(std::move(stylizer)), rig_(rig), strengths_(stylizer_.model().styles().size()) {}

void Character::reset() noexcept {
  stylizer_.reset();
  foot_lock_.reset();
  started_ = false;
  last_ = {};
  held_way_ = {};
  held_turn_ = 0;
  lift_ = 0;
}

void Character::ease(std::span<const float> strengths, const Shape& shape, float seconds) noexcept {
  const float share = started_ ? filter_gain(seconds, kEaseSeconds) : 1.0f;
  float total = 0;
  for (size_t i = 0; i < strengths_.size(); ++i) {
    const float wanted = std::isfinite(strengths[i]) ? std::clamp(strengths[i], -4.0f, 4.0f) : 0;
    approach(strengths_[i], wanted, share);
    total += std::abs(strengths_[i]);
  }
  amount_ = std::min(1.0f, 4 * total);
  approach(shape_.posture, bounded(shape.posture), share);
  approach(shape_.dynamics, bounded(shape.dynamics), share);
  approach(shape_.timing, bounded(shape.timing), share);
  approach(shape_.foot_lock, std::min(1.0f, bounded(shape.foot_lock)), share);
  for (int r = 0; r < kRegions; ++r) {
    approach(shape_.regions[r], bounded(shape.regions[r]), share);
  }
}

// The mean is kept up at all times, so that a change of mind finds it.
void Character::weigh_in_time(float seconds, BodyChange& change) noexcept {
  const float share = started_ ? filter_gain(seconds, kPostureSeconds) : 1.0f;
  const bool whole = shape_.posture == 1 && shape_.dynamics == 1;
  for (int j = 0; j < kHumanJoints; ++j) {
    const Vec3 turn = log_rotation(change.rotations[j]);
    Vec3& mean = mean_turns_[j];
    mean += (turn - mean) * share;
    if (!whole) {
      change.rotations[j] = exp_rotation(mean * shape_.posture + (turn - mean) * shape_.dynamics);
    }
  }
  float& height = change.translation.y;
  mean_height_ += (height - mean_height_) * share;
  if (!whole) {
    height = mean_height_ * shape_.posture + (height - mean_height_) * shape_.dynamics;
  }
}

// A joint's own part of the change is what it turns beyond the joint that it hangs on.
void Character::weigh_regions(BodyChange& change) const noexcept {
  if (shape_.regions == Shape{}.regions) return;
  const std::array<Quat, kHumanJoints> whole = change.rotations;
  for (int j = 0; j < kHumanJoints; ++j) {
    const float weight = shape_.regions[region_of(j)];
    const int parent = kHumanParent[j];
    const Quat own = parent < 0 ? whole[j] : conjugate(whole[parent]) * whole[j];
    const Quat weighed = exp_rotation(log_rotation(own) * weight);
    change.rotations[j] = parent < 0 ? weighed : normalized(change.rotations[parent] * weighed);
  }
  change.translation.y *= shape_.regions[kLegs];
}

// The way is a sum over time: what is held back now stays held back, so that nobody jumps.
void Character::hold_back_way(BodyChange& change) noexcept {
  const float held = 1 - std::min(1.0f, shape_.dynamics * shape_.regions[kLegs]);
  const Vec3 step = change.translation - last_.translation;
  const float turn = change.turn - last_.turn;
  last_ = change;
  if (started_) {
    held_way_ += Vec3{step.x, 0, step.z} * held;
    held_turn_ += turn * held;
  }
  change.translation = change.translation - held_way_;
  change.turn -= held_turn_;
}

void Character::step(ConstPose in, std::span<const float> strengths, const Shape& shape,
                     double input_seconds, double output_seconds, Pose out) noexcept {
  const auto seconds = static_cast<float>(std::clamp(output_seconds, 0.0, 0.5));
  ease(strengths, shape, seconds);
  rig_.read(in, body_);
  stylizer_.step(in, strengths_, input_seconds, output_seconds, out);
  BodyChange change = stylizer_.change();
  hold_back_way(change);
  weigh_in_time(seconds, change);
  weigh_regions(change);
  HumanPositions joints;
  changed_joints(body_, change, joints);
  const Shape whole;
  const bool reshaped =
      shape_.posture != 1 || shape_.dynamics != 1 || shape_.regions != whole.regions;
  // The stylizer's lift is for legs as they were before. What others want beyond it comes and goes
  // as slowly, or the whole body would start at every step.
  const float depth = reshaped ? floor_depth(body_, joints, change) : 0.0f;
  approach(lift_, depth, started_ ? filter_gain(seconds, kLiftSeconds) : 1.0f);
  change.translation.y += amount_ * lift_;
  foot_lock_.step(body_, joints, stylizer_.contacts().first<kFeet>(), amount_ * shape_.foot_lock,
                  seconds, change);
  rig_.write(in, body_, change, out);
  started_ = true;
}

double Character::rate() const noexcept {
  if (shape_.timing == 1) return stylizer_.rate();
  const double log_rate = static_cast<double>(shape_.timing) * std::log(stylizer_.rate());
  return std::exp(std::clamp(log_rate, -kMaxLogRate, kMaxLogRate));
}

}  // namespace panache::web
