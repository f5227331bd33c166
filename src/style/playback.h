#pragma once
// The input of the last seconds, what is predicted of the next, and a play head between them: it
// goes through a live input at the tempo of a style.

#include <memory>
#include <optional>
#include <vector>

#include "style/input_ring.h"
#include "style/play_head.h"
#include "style/pose_predictor.h"
#include "style/stages/flight.h"
#include "style/stages/root_motion.h"

namespace panache {

struct PlaybackOptions {
  // How far the play head may be behind the input, and how far ahead of it, seconds: 0 to
  // kMaxLag, and 0 to PredictorNetwork::kMaxSeconds. With both at 0 nothing is delayed, and the
  // tempo is the input's own.
  double max_lag = 0, max_lead = 0;
  // Where the head is late by a whole cycle of a gait (or of anything that repeats), it leaves out
  // that cycle; where it can go no further ahead, it plays the last one again. So a style can be
  // slower or faster than its input indefinitely. Needs a max_lag longer than a cycle.
  bool skip_cycles = false;
  static constexpr double kMaxLag = 4;
};

// What a skipped or repeated cycle would have added to the way is left out of it, or added: the
// character goes on from where it is, and stands elsewhere than its input does. The constructor
// allocates; nothing else does, and nothing fails.
class Playback {
 public:
  // `max_speed`: see Observer; `model`: predicts the input, where `options` ask for a lead.
  Playback(const Rig& rig, float max_speed, std::shared_ptr<const Model> model,
           const PlaybackOptions& options);

  // Forgets the motion so far, and with it lag, lead and place.
  void reset() noexcept;
  // Takes in the newest pose; returns whether it continues the motion, see Observer. Otherwise all
  // before it is forgotten.
  bool take_in(ConstPose in, double seconds) noexcept;

  // What a play head shows next.
  struct Shown {
    ConstPose pose;  // Good until the next one.
    double seconds;  // Of the input, since the last one.
    float flight;    // See FlightWatch::amount().
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
  void forget() noexcept;  // Of the motion so far, all but the observer's part.
  void skip_cycle(double rate) noexcept;
  void look_ahead(double seconds) noexcept;
  RootPose root_at(double ahead) const noexcept;
  void pose_at(double ahead, const RootOffset& offset, Pose out) noexcept;
  void blend_from_old(double seconds, double played, Pose shown) noexcept;

  PlaybackOptions options_;
  PlayHead head_;
  int skipped_ = 0;
  Observer input_;  // The newest pose; the stylizer's own is that of the play head.
  InputRing ring_;
  FlightWatch flights_;  // Of the newest poses, which the play head may still be behind.
  std::optional<PosePredictor> predictor_;
  PredictedPose ahead_;  // The smoothed lead of the play head's body over the newest.
  // The body that is shown, and the one before a skip. [joints]
  std::vector<Quat> shown_rotations_, old_rotations_;
  std::vector<Vec3> shown_translations_, old_translations_;
  double time_ = 0;                 // Input seconds since the start,
  double searched_ = 0;             // and when a cycle was last looked for.
  RootOffset offset_, old_offset_;  // Of skipped cycles; its turn fades.
  double old_ahead_ = 0;            // Of the head as it was before the last skip,
  double blended_ = 1;              // and how much of the way from it is done, 0 to 1.
};

}  // namespace panache
