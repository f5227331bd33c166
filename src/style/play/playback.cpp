#include "style/play/playback.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/elementary.h"
#include "rig/humanoid.h"
#include "style/play/input_ring.h"
#include "style/stages/shaping.h"

namespace panache {
namespace {

constexpr double kEase = 0.1;         // Seconds.
constexpr double kReturnSpeed = 0.1;  // Relative to the clock: a tenth is not noticeable.
constexpr double kReturnSeconds = 0.5;

double smooth(double t) {
  t = std::clamp(t, 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

}  // namespace

double PlayHead::ease() const noexcept { return std::min(kEase, (max_lag_ + max_lead_) / 2); }

double PlayHead::room_ahead() const noexcept {
  return ease() > 0 ? smooth((max_lead_ - ahead_) / ease()) : 0;
}

double PlayHead::room_behind() const noexcept {
  return ease() > 0 ? smooth((ahead_ + max_lag_) / ease()) : 0;
}

double PlayHead::advance(double seconds, double rate, bool styled) noexcept {
  const double before = ahead_;
  if (!styled) {
    const double back = std::clamp(ahead_ / kReturnSeconds, -kReturnSpeed, kReturnSpeed);
    ahead_ -= back * seconds;
    if (std::abs(ahead_) < 1e-3) ahead_ = 0;
  } else if (rate > 1) {
    ahead_ += (rate - 1) * room_ahead() * seconds;
  } else {
    ahead_ += (rate - 1) * room_behind() * seconds;
  }
  // A long step may have gone too far.
  ahead_ = std::clamp(ahead_, -max_lag_, max_lead_);
  return std::max(0.0, seconds + ahead_ - before);
}

namespace {

// The length of a cycle: even a shuffle of two steps takes longer than the minimum. Seconds.
constexpr double kShortestCycle = 0.4, kLongestCycle = 2.0;
// The poses this long before must be similar, too. Seconds.
constexpr double kBeforeCycle = 0.1;

// Two poses match if their joints are this close, on average and each. Metres. Cycles of one
// person's walk differ by two to three centimetres in the mean.
constexpr float kMaxDistance = 0.04f, kMaxDistanceEach = 0.15f;
constexpr double kCandidates = 1.0 / 60;  // Seconds between compared poses.

// The offset from `at` (a time in `ring`) of the most similar pose, among offsets from `nearest` to
// `farthest` (seconds, negative is earlier); nothing if none is similar enough. `ring` must reach
// kBeforeCycle further back than both.
std::optional<double> find_cycle(const InputRing& ring, double at, double nearest,
                                 double farthest) noexcept {
  const HumanPositions here = ring.body(at), before = ring.body(at - kBeforeCycle);
  std::optional<double> best;
  float min = kMaxDistance;
  const int candidates = static_cast<int>(std::floor((farthest - nearest) / kCandidates)) + 1;
  for (int c = 0; c < candidates; ++c) {
    const double away = nearest + c * kCandidates, to = at + away;
    const PoseDistance now = pose_distance(here, ring.body(to)),
                       then = pose_distance(before, ring.body(to - kBeforeCycle));
    const float mean = (now.mean + then.mean) / 2;
    if (mean >= min || std::max(now.largest, then.largest) > kMaxDistanceEach) continue;
    min = mean;
    best = away;
  }
  return best;
}

constexpr double kSearchEvery = 0.06;  // Seconds.
constexpr double kBlend = 0.2;         // Seconds from the old head to the new one.
// Time constant for predictions beyond the newest pose, which are noisier than motion.
constexpr float kLeadSeconds = 0.04f;

}  // namespace

Playback::Playback(const Rig& rig, float max_speed, std::shared_ptr<const Model> model,
                   const PlaybackOptions& options)
    : options_(options),
      head_(options.max_lag, options.max_lead),
      input_(rig, max_speed),
      // A candidate for a cycle needs earlier poses, too.
      ring_(rig.joint_count(), options.max_lag + (options.skip_cycles ? kBeforeCycle + kBlend : 0)),
      shown_rotations_(rig.joint_count()),
      old_rotations_(rig.joint_count()),
      shown_translations_(rig.joint_count()),
      old_translations_(rig.joint_count()) {
  if (options.max_lead > 0) predictor_.emplace(std::move(model));
}

void Playback::reset() noexcept {
  forget();
  input_.reset();
}

void Playback::forget() noexcept {
  head_.reset();
  skipped_ = 0;
  ring_.clear();
  flights_.reset();
  if (predictor_) predictor_->reset();
  ahead_ = {};
  time_ = searched_ = 0;
  offset_ = old_offset_ = {};
  old_ahead_ = 0, blended_ = 1;
}

bool Playback::take_in(ConstPose in, double seconds) noexcept {
  const bool continues = input_.observe(in, seconds);
  if (!continues) forget();
  time_ += seconds;
  const Observation& now = input_.now();
  ring_.push(time_, input_.pose(), now.body_frame, now.root);
  flights_.push(time_, now.world.positions);
  if (predictor_) predictor_->push(time_, now.body_frame, now.root);
  return continues;
}

RootPose Playback::root_at(double ahead) const noexcept {
  if (ahead <= 0) return ring_.root(time_ + ahead);
  const RootPose& now = input_.now().root;
  return {now.position + ahead_.root.position, now.facing + ahead_.root.facing};
}

void Playback::look_ahead(double seconds) noexcept {
  if (!predictor_) return;
  const Observation& now = input_.now();
  const PredictedPose wanted = predictor_->predict(std::max(head_.ahead(), 0.0));
  const float gain = filter_gain(static_cast<float>(seconds), kLeadSeconds);
  for (size_t j = 0; j < kHumanJoints; ++j) {
    ahead_.body[j] += (wanted.body[j] - now.body_frame[j] - ahead_.body[j]) * gain;
  }
  const RootPose offset{wanted.root.position - now.root.position,
                        wanted.root.facing - now.root.facing};
  ahead_.root.position += (offset.position - ahead_.root.position) * gain;
  ahead_.root.facing += (offset.facing - ahead_.root.facing) * gain;
}

// The pose at a play head, with its offset.
void Playback::pose_at(double ahead, const RootOffset& offset, Pose out) noexcept {
  const Observation& now = input_.now();
  if (ahead > 0) {
    PredictedPose predicted{now.body_frame, root_at(ahead)};
    for (size_t j = 0; j < kHumanJoints; ++j) predicted.body[j] += ahead_.body[j];
    input_.write(change_between({now.body_frame, now.root}, predicted), out);
  } else {
    ring_.pose(time_ + ahead, out);
  }
  // Turns the whole body in place and moves it, by its root joints.
  input_.rig().transform_root(offset.turn, root_at(ahead).position, offset.translation, out);
}

// Skips or repeats a cycle if that is due and the motion has one.
void Playback::skip_cycle(double rate) noexcept {
  if (!options_.skip_cycles || blended_ < 1 || time_ - searched_ < kSearchEvery) return;
  searched_ = time_;
  const double at = time_ + std::min(head_.ahead(), 0.0);
  std::optional<double> away;
  if (rate < 1) {
    // Lagging by a cycle: look for a later, similar pose.
    away = find_cycle(ring_, at, kShortestCycle, std::min(kLongestCycle, time_ - at));
  } else if (rate > 1 && head_.room_ahead() < 1) {
    // At the maximum lead: look for an earlier one.
    const double oldest = std::max(ring_.oldest() + kBeforeCycle, time_ - options_.max_lag);
    away = find_cycle(ring_, at, std::max(-kLongestCycle, oldest - at), -kShortestCycle);
  }
  if (!away) return;
  old_ahead_ = head_.ahead();
  old_offset_ = offset_;
  const RootPose old = root_at(old_ahead_), next = root_at(old_ahead_ + *away);
  offset_.translation += old.position - next.position;
  offset_.turn += old.facing - next.facing;
  blended_ = 0;
  head_.jump(*away);
  skipped_ += *away > 0 ? 1 : -1;
}

// The old head continues during the blend to the new one.
void Playback::blend_from_old(double seconds, double played, Pose shown) noexcept {
  if (blended_ >= 1) return;
  blended_ = std::min(1.0, blended_ + seconds / kBlend);
  old_ahead_ = std::clamp(old_ahead_ + played - seconds, -options_.max_lag, options_.max_lead);
  const Pose old{old_rotations_, old_translations_};
  pose_at(old_ahead_, old_offset_, old);
  const float share = static_cast<float>(smooth(blended_));
  for (size_t j = 0; j < shown.rotations.size(); ++j) {
    shown.rotations[j] = nlerp(old.rotations[j], shown.rotations[j], share);
    shown.translations[j] = lerp(old.translations[j], shown.translations[j], share);
  }
}

Playback::Shown Playback::show(double seconds, double rate, bool styled) noexcept {
  const double played = head_.advance(seconds, rate, styled);
  offset_.turn *= exponential(-static_cast<float>(seconds) / kCourseSeconds);
  look_ahead(seconds);
  skip_cycle(rate);

  const Pose shown{shown_rotations_, shown_translations_};
  pose_at(head_.ahead(), offset_, shown);
  blend_from_old(seconds, played, shown);
  return {shown, {played, seconds, flights_.amount(time_ + head_.ahead())}};
}

}  // namespace panache
