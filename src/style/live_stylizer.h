#pragma once
// One character being restyled live, with the tempo of the style as far as time allows.

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "style/input_ring.h"
#include "style/play_head.h"
#include "style/pose_predictor.h"
#include "style/removal_pass.h"
#include "style/stylizer.h"

namespace panache {

struct LiveOptions {
  StylizerOptions stylizer;
  // How far the play head may be behind the input, and how far ahead of it, seconds: 0 to
  // kMaxLag, and 0 to PredictorNetwork::kMaxSeconds. With both at 0 nothing is delayed, and the
  // tempo is the input's own.
  double max_lag = 0, max_lead = 0;
  // Where the head is late by a whole cycle of a gait (or of anything that repeats), it leaves out
  // that cycle; where it can go no further ahead, it plays the last one again. So a style can be
  // slower or faster than its input indefinitely. Needs a max_lag longer than a cycle.
  bool skip_cycles = false;
  // A model that takes styles off (removal.h); null: none. See set_removed().
  std::shared_ptr<const Model> remover = nullptr;
  static constexpr double kMaxLag = 4;
};

// A stylizer, the input of the last `max_lag` seconds, and a play head between them. What a skipped
// or repeated cycle would have added to the way is left out of it, or added: the character goes on
// from where it is, and stands elsewhere than its input does.
class LiveStylizer {
 public:
  // Fails with a message where an option of time is out of its range, or where `max_lead` is asked
  // of a model that predicts nothing.
  static Result<void> check(const Model& model, const LiveOptions& options);
  // Fails likewise, and where Stylizer::create() does.
  static Result<LiveStylizer> create(std::shared_ptr<const Model> model, Rig rig,
                                     const LiveOptions& options = {});

  // Forgets the motion so far, and with it lag, lead and place.
  void reset() noexcept;

  // See Stylizer::step(); `seconds` passed since the last step. Allocates nothing, never fails.
  void step(ConstPose in, std::span<const float> strengths, double seconds, Pose out) noexcept;

  // The style of the remover that is taken off the input before all else, at the input's tempo; -1:
  // none, as at first. Eased as strengths are. Other numbers are ignored.
  void set_removed(int style) noexcept {
    if (removal_) removal_->set_removed(style);
  }

  // Where the shown input is: seconds after the newest pose, below zero if late, at the last step.
  double ahead() const noexcept { return head_.ahead(); }
  // Cycles left out (above zero) and played again (below) since the start, in sum.
  int skipped_cycles() const noexcept { return skipped_; }
  // Whether time is the input's own and nothing is taken off, so that a step is that of the
  // stylizer alone.
  bool is_pass_through() const noexcept { return !playback_ && !removal_; }

  // See Stylizer.
  Stylizer& stylizer() noexcept { return stylizer_; }
  const Stylizer& stylizer() const noexcept { return stylizer_; }
  size_t state_size() const noexcept;
  void save(std::span<std::byte> out) const noexcept;
  bool restore(std::span<const std::byte> in) noexcept;

 private:
  // The state for playback at other times than now.
  struct Playback {
    Playback(const Rig& rig, std::shared_ptr<const Model> model, const LiveOptions& options);

    Observer input;  // The newest pose; the stylizer's own is that of the play head.
    InputRing ring;
    FlightWatch flights;  // Of the newest poses, which the play head may still be behind.
    std::optional<PosePredictor> predictor;
    // The smoothed lead of the play head's body over the newest.
    PredictedPose ahead;
    // The body that is shown, and the one before a skip.
    std::vector<Quat> shown_rotations, old_rotations;        // [joints]
    std::vector<Vec3> shown_translations, old_translations;  // [joints]
    double time = 0;                                         // Input seconds since the start,
    double searched = 0;  // and when a cycle was last looked for.
    // The root offset of skipped cycles; its turn fades.
    RootOffset offset, old_offset;
    double old_ahead = 0;  // Of the head as it was before the last skip,
    double blended = 1;    // and how much of the way from it is done, 0 to 1.
  };

  LiveStylizer(Stylizer stylizer, std::shared_ptr<const Model> model, const LiveOptions& options);

  void forget() noexcept;  // Of the motion so far, all but the observer's part.
  void take_input(ConstPose in, double seconds) noexcept;
  void skip_cycle(double rate) noexcept;
  void look_ahead(double seconds) noexcept;
  RootPose root_at(double ahead) const noexcept;
  size_t removal_state_size() const noexcept { return removal_ ? removal_->state_size() : 0; }
  void pose_at(double ahead, const RootOffset& offset, Pose out) noexcept;
  void blend_from_old(double seconds, double played, Pose shown) noexcept;
  template <class Self, class Visit>
  static void visit_state(Self& self, Visit&& visit);

  LiveOptions options_;
  Stylizer stylizer_;
  PlayHead head_;
  int skipped_ = 0;
  std::unique_ptr<Playback> playback_;  // Null where time is the input's own.
  std::optional<RemovalPass> removal_;  // With a remover.
};

}  // namespace panache
