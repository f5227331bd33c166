#include "style/live_stylizer.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "base/one_pole.h"
#include "style/cycle_search.h"
#include "style/pose_change.h"
#include "style/state_bytes.h"

namespace panache {
namespace {

constexpr double kSearchEvery = 0.06;  // Seconds.
constexpr double kBlend = 0.2;         // Seconds from the old head to the new one.
// Time constant of what is predicted beyond the newest pose: guesses tremble more than motion does.
constexpr float kLeadSeconds = 0.04f;

float smooth(double t) { return static_cast<float>(t * t * (3 - 2 * t)); }

}  // namespace

LiveStylizer::Playback::Playback(const Rig& rig, std::shared_ptr<const Model> model,
                                 const LiveOptions& options)
    : input(rig, options.stylizer.max_speed),
      // A candidate for a cycle needs what was before it.
      ring(rig.joint_count(), options.max_lag + (options.skip_cycles ? kBeforeCycle + kBlend : 0)),
      shown_rotations(rig.joint_count()),
      old_rotations(rig.joint_count()),
      shown_translations(rig.joint_count()),
      old_translations(rig.joint_count()) {
  if (options.max_lead > 0) predictor.emplace(std::move(model));
}

Result<void> LiveStylizer::check(const Model& model, const LiveOptions& options) {
  const struct {
    const char* name;
    double value, most;
    const char* expected;
  } ranges[] = {
      {"max_lag", options.max_lag, LiveOptions::kMaxLag, "0 to 4"},
      {"max_lead", options.max_lead, PredictorNetwork::kMaxSeconds, "0 to 0.25"},
  };
  for (const auto& [name, value, most, expected] : ranges) {
    if (!(value >= 0 && value <= most)) {
      return Error{std::string(name) + " of " + std::to_string(value) + " seconds; expected " +
                   expected + " seconds"};
    }
  }
  if (options.max_lead > 0 && !model.predictor()) {
    return Error{
        "max_lead needs a model that predicts input, which this one does not; train it again or "
        "set max_lead to 0"};
  }
  return {};
}

Result<LiveStylizer> LiveStylizer::create(std::shared_ptr<const Model> model, Rig rig,
                                          const LiveOptions& options) {
  if (Result<void> good = check(*model, options); !good) return good.error();
  Result<Stylizer> stylizer = Stylizer::create(model, std::move(rig), options.stylizer);
  if (!stylizer) return stylizer.error();
  LiveStylizer live(*std::move(stylizer), std::move(model), options);
  if (options.remover) {
    Result<RemovalPass> removal =
        RemovalPass::create(options.remover, live.stylizer_.rig(), options.stylizer);
    if (!removal) return removal.error();
    live.removal_.emplace(*std::move(removal));
  }
  return live;
}

LiveStylizer::LiveStylizer(Stylizer stylizer, std::shared_ptr<const Model> model,
                           const LiveOptions& options)
    : options_(options), stylizer_(std::move(stylizer)), head_(options.max_lag, options.max_lead) {
  if (options.max_lag > 0 || options.max_lead > 0) {
    playback_ = std::make_unique<Playback>(stylizer_.rig(), std::move(model), options);
  }
}

void LiveStylizer::reset() noexcept {
  forget();
  if (removal_) removal_->reset();
  stylizer_.reset();
  if (playback_) playback_->input.reset();
}

void LiveStylizer::forget() noexcept {
  stylizer_.forget_motion();
  head_.reset();
  skipped_ = 0;
  if (!playback_) return;
  Playback& p = *playback_;
  p.ring.clear();
  p.flights.reset();
  if (p.predictor) p.predictor->reset();
  p.ahead = {};
  p.time = p.searched = 0;
  p.offset = p.old_offset = {};
  p.old_ahead = 0, p.blended = 1;
}

void LiveStylizer::take_input(ConstPose in, double seconds) noexcept {
  Playback& p = *playback_;
  if (!p.input.observe(in, seconds)) forget();
  p.time += seconds;
  const Observation& now = p.input.now();
  p.ring.push(p.time, p.input.pose(), now.body_frame, now.root);
  p.flights.push(p.time, now.world.positions);
  if (p.predictor) p.predictor->push(p.time, now.body_frame, now.root);
}

RootPose LiveStylizer::root_at(double ahead) const noexcept {
  const Playback& p = *playback_;
  if (ahead <= 0) return p.ring.root(p.time + ahead);
  const RootPose& now = p.input.now().root;
  return {now.position + p.ahead.root.position, now.facing + p.ahead.root.facing};
}

void LiveStylizer::look_ahead(double seconds) noexcept {
  Playback& p = *playback_;
  if (!p.predictor) return;
  const Observation& now = p.input.now();
  const PredictedPose wanted = p.predictor->predict(std::max(head_.ahead(), 0.0));
  const float gain = filter_gain(static_cast<float>(seconds), kLeadSeconds);
  for (size_t j = 0; j < kHumanJoints; ++j) {
    p.ahead.body[j] += (wanted.body[j] - now.body_frame[j] - p.ahead.body[j]) * gain;
  }
  const RootPose way{wanted.root.position - now.root.position,
                     wanted.root.facing - now.root.facing};
  p.ahead.root.position += (way.position - p.ahead.root.position) * gain;
  p.ahead.root.facing += (way.facing - p.ahead.root.facing) * gain;
}

// The pose at a play head, with its offset.
void LiveStylizer::pose_at(double ahead, const RootOffset& offset, Pose out) noexcept {
  Playback& p = *playback_;
  const Observation& now = p.input.now();
  if (ahead > 0) {
    PredictedPose predicted{now.body_frame, root_at(ahead)};
    for (size_t j = 0; j < kHumanJoints; ++j) predicted.body[j] += p.ahead.body[j];
    p.input.write(change_between({now.body_frame, now.root}, predicted), out);
  } else {
    p.ring.pose(p.time + ahead, out);
  }
  // The whole body, by its root joints: turned where it stands, and moved.
  p.input.rig().transform_root(offset.turn, root_at(ahead).position, offset.translation, out);
}

// Leaves out a cycle, or plays one again, where that is due and the motion has one.
void LiveStylizer::skip_cycle(double rate) noexcept {
  Playback& p = *playback_;
  if (!options_.skip_cycles || p.blended < 1 || p.time - p.searched < kSearchEvery) return;
  p.searched = p.time;
  const double at = p.time + std::min(head_.ahead(), 0.0);
  std::optional<double> away;
  if (rate < 1) {
    // Late by a cycle: a moment that came later and looks the same.
    away = find_cycle(p.ring, at, kShortestCycle, std::min(kLongestCycle, p.time - at));
  } else if (rate > 1 && head_.room_ahead() < 1) {
    // At the bound: one that came earlier.
    const double oldest = std::max(p.ring.oldest() + kBeforeCycle, p.time - options_.max_lag);
    away = find_cycle(p.ring, at, std::max(-kLongestCycle, oldest - at), -kShortestCycle);
  }
  if (!away) return;
  p.old_ahead = head_.ahead();
  p.old_offset = p.offset;
  const RootPose old = root_at(p.old_ahead), next = root_at(p.old_ahead + *away);
  p.offset.translation += old.position - next.position;
  p.offset.turn += old.facing - next.facing;
  p.blended = 0;
  head_.jump(*away);
  skipped_ += *away > 0 ? 1 : -1;
}

// The head as it was goes on beside the new one until that has taken over.
void LiveStylizer::blend_from_old(double seconds, double played, Pose shown) noexcept {
  Playback& p = *playback_;
  if (p.blended >= 1) return;
  p.blended = std::min(1.0, p.blended + seconds / kBlend);
  p.old_ahead = std::clamp(p.old_ahead + played - seconds, -options_.max_lag, options_.max_lead);
  const Pose old{p.old_rotations, p.old_translations};
  pose_at(p.old_ahead, p.old_offset, old);
  const float share = smooth(p.blended);
  for (size_t j = 0; j < shown.rotations.size(); ++j) {
    shown.rotations[j] = nlerp(old.rotations[j], shown.rotations[j], share);
    shown.translations[j] = lerp(old.translations[j], shown.translations[j], share);
  }
}

void LiveStylizer::step(ConstPose in, std::span<const float> strengths, double seconds,
                        Pose out) noexcept {
  if (removal_) in = removal_->step(in, seconds, seconds);
  if (!playback_) return stylizer_.step(in, strengths, seconds, out);
  Playback& p = *playback_;
  seconds = bounded_seconds(seconds);
  take_input(in, seconds);

  const double rate = stylizer_.rate();
  const double played = head_.advance(seconds, rate, stylizer_.amount() > 0);
  p.offset.turn *= exponential(-static_cast<float>(seconds) / kCourseSeconds);
  look_ahead(seconds);
  skip_cycle(rate);

  const Pose shown{p.shown_rotations, p.shown_translations};
  pose_at(head_.ahead(), p.offset, shown);
  blend_from_old(seconds, played, shown);
  stylizer_.step(shown, strengths, {played, seconds, p.flights.amount(p.time + head_.ahead())},
                 out);
}

template <class Self, class Visit>
void LiveStylizer::visit_state(Self& self, Visit&& visit) {
  PlayHead::visit_state(self.head_, visit);
  visit(self.skipped_);
  auto& p = *self.playback_;
  Observer::visit_state(p.input, visit);
  InputRing::visit_state(p.ring, visit);
  FlightWatch::visit_state(p.flights, visit);
  if (p.predictor) PosePredictor::visit_state(*p.predictor, visit);
  visit(p.ahead), visit(p.time), visit(p.searched), visit(p.offset), visit(p.old_offset);
  visit(p.old_ahead), visit(p.blended);
}

size_t LiveStylizer::state_size() const noexcept {
  const size_t own =
      playback_ ? state_bytes([this](auto&& visit) { visit_state(*this, visit); }) : size_t{0};
  return stylizer_.state_size() + removal_state_size() + own;
}

void LiveStylizer::save(std::span<std::byte> out) const noexcept {
  assert(out.size() == state_size());
  const size_t size = stylizer_.state_size(), first = removal_state_size();
  stylizer_.save(out.first(size));
  if (removal_) removal_->save(out.subspan(size, first));
  if (!playback_) return;
  write_state(out.subspan(size + first), [this](auto&& visit) { visit_state(*this, visit); });
}

bool LiveStylizer::restore(std::span<const std::byte> in) noexcept {
  if (in.size() != state_size()) return false;
  const size_t size = stylizer_.state_size(), first = removal_state_size();
  const auto removal = in.subspan(size, first), own = in.subspan(size + first);
  if (playback_ && !is_whole_state(own)) return false;
  if (removal_ && !is_whole_state(removal)) return false;
  if (!stylizer_.restore(in.first(size))) return false;
  if (removal_) removal_->restore(removal);
  if (playback_) read_state(own, [this](auto&& visit) { visit_state(*this, visit); });
  return true;
}

}  // namespace panache
