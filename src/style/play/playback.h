#pragma once
// Plays a live input at the tempo of a style: the recent input, a prediction of the next, and a
// play head between them, which lags or leads within bounds.

#include <memory>
#include <optional>
#include <vector>

#include "style/play/input_ring.h"
#include "style/play/pose_predictor.h"
#include "style/stages/flight.h"
#include "style/stages/root_motion.h"

namespace panache {

// A style plays its input faster or slower than it arrives. Live, the head can lag by `max_lag`
// and, if input is predicted, lead by `max_lead`; near a bound the rate eases to 1. Without a style
// it returns to the newest input.
class PlayHead {
 public:
  // Seconds, both 0 or more.
  PlayHead(double max_lag, double max_lead) : max_lag_(max_lag), max_lead_(max_lead) {}

  void reset() noexcept { ahead_ = 0; }
  // Advances by `seconds` of the clock; `rate`: the style's input seconds per second, ignored
  // unless `styled`. Returns the input seconds that the head moved.
  double advance(double seconds, double rate, bool styled) noexcept;
  // Jumps by `seconds` in the input.
  void jump(double seconds) noexcept { ahead_ += seconds; }

  // Seconds from the newest input to the head; negative: it lags.
  double ahead() const noexcept { return ahead_; }
  // How freely a style can still play faster (slower) than its input, 0 to 1.
  double room_ahead() const noexcept;
  double room_behind() const noexcept;

  // Calls visit(member) for everything that tells one head from another with its bounds.
  template <class Self, class Visit>
  static void visit_state(Self& self, Visit&& visit) {
    visit(self.ahead_);
  }

 private:
  // The rate eases over this time before a bound, at most half the distance of the bounds. Seconds.
  double ease() const noexcept;

  double max_lag_, max_lead_;
  double ahead_ = 0;
};

struct PlaybackOptions {
  // How far the play head may be behind the input, and how far ahead of it, seconds: 0 to
  // kMaxLag, and 0 to PredictorNetwork::kMaxSeconds. With both at 0 nothing is delayed, and the
  // tempo is the input's own.
  double max_lag = 0, max_lead = 0;
  // If the head lags by a whole cycle of a gait (or of any repetition), it skips that cycle; if it
  // reaches the maximum lead, it repeats the last one. This lets a style be slower or faster than
  // its input indefinitely. Needs a max_lag longer than a cycle.
  bool skip_cycles = false;
  static constexpr double kMaxLag = 4;
};

// A skipped cycle is missing from the way, a repeated one is added to it: the character continues
// from its position, which then differs from the input's. Only the constructor allocates; nothing
// fails.
class Playback {
 public:
  // `max_speed`: see Observer; `model`: predicts the input if `options` allow a lead.
  Playback(const Rig& rig, float max_speed, std::shared_ptr<const Model> model,
           const PlaybackOptions& options);

  // Forgets the motion so far, including lag, lead and position.
  void reset() noexcept;
  // Adds the newest pose; returns whether it continues the motion, see Observer. If not, everything
  // before it is forgotten.
  bool take_in(ConstPose in, double seconds) noexcept;

  // The next pose at the play head.
  struct Shown {
    ConstPose pose;  // Valid until the next call.
    StepMoment moment;
  };
  // `seconds`: since the last pose; `rate`: see PlayHead::advance().
  Shown show(double seconds, double rate, bool styled) noexcept;

  // See LiveStylizer.
  double ahead() const noexcept { return head_.ahead(); }
  int skipped_cycles() const noexcept { return skipped_; }

  // Calls visit(member) for everything that tells one character from another.
  template <class Self, class Visit>
  static void visit_state(Self& self, Visit&& visit) {
    PlayHead::visit_state(self.head_, visit);
    visit(self.skipped_);
    Observer::visit_state(self.input_, visit);
    InputRing::visit_state(self.ring_, visit);
    FlightWatch::visit_state(self.flights_, visit);
    if (self.predictor_) PosePredictor::visit_state(*self.predictor_, visit);
    visit(self.ahead_), visit(self.time_), visit(self.searched_), visit(self.offset_);
    visit(self.old_offset_), visit(self.old_ahead_), visit(self.blended_);
  }

 private:
  void forget() noexcept;  // Forgets all but the observer.
  void skip_cycle(double rate) noexcept;
  void look_ahead(double seconds) noexcept;
  RootPose root_at(double ahead) const noexcept;
  void pose_at(double ahead, const RootOffset& offset, Pose out) noexcept;
  void blend_from_old(double seconds, double played, Pose shown) noexcept;

  PlaybackOptions options_;
  PlayHead head_;
  int skipped_ = 0;
  Observer input_;  // Sees the newest pose; the stylizer's sees the play head's.
  InputRing ring_;
  FlightWatch flights_;  // Up to the newest pose, so it can see ahead of the play head.
  std::optional<PosePredictor> predictor_;
  PredictedPose ahead_;  // The smoothed difference from the newest pose to the play head's.
  // The shown pose, and the one from before a skip. [joints]
  std::vector<Quat> shown_rotations_, old_rotations_;
  std::vector<Vec3> shown_translations_, old_translations_;
  double time_ = 0;                 // Input seconds since the start,
  double searched_ = 0;             // and the time of the last search for a cycle.
  RootOffset offset_, old_offset_;  // From skipped and repeated cycles; the turn fades.
  double old_ahead_ = 0;            // The head's position before the last skip,
  double blended_ = 1;              // and the progress of the blend from it, 0 to 1.
};

}  // namespace panache
