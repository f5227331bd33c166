#pragma once
// One character being restyled live, with the tempo of the style as far as time allows.

#include <memory>
#include <optional>
#include <span>

#include "style/playback.h"
#include "style/removal_pass.h"
#include "style/stylizer.h"

namespace panache {

struct LiveOptions : PlaybackOptions {
  StylizerOptions stylizer;
  // A model that takes styles off (removal.h); null: none. See set_removed().
  std::shared_ptr<const Model> remover = nullptr;
};

// A stylizer, and what goes before it: a pass that takes a style off, and a playback.
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
  double ahead() const noexcept { return playback_ ? playback_->ahead() : 0; }
  // Cycles left out (above zero) and played again (below) since the start, in sum.
  int skipped_cycles() const noexcept { return playback_ ? playback_->skipped_cycles() : 0; }
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
  LiveStylizer(Stylizer stylizer, std::shared_ptr<const Model> model, const LiveOptions& options);

  size_t removal_state_size() const noexcept { return removal_ ? removal_->state_size() : 0; }

  Stylizer stylizer_;
  std::unique_ptr<Playback> playback_;  // Null where time is the input's own.
  std::optional<RemovalPass> removal_;  // With a remover.
};

}  // namespace panache
