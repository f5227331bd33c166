#pragma once
// Restyles one character live, with the style's tempo as far as lag and lead allow.

#include <memory>
#include <optional>
#include <span>

#include "style/play/playback.h"
#include "style/play/removal.h"
#include "style/stylizer.h"

namespace panache {

struct LiveOptions : PlaybackOptions {
  StylizerOptions stylizer;
  // A model that takes styles off (removal.h); null: none. See set_removed().
  std::shared_ptr<const Model> remover = nullptr;
};

// A stylizer, preceded by a pass that takes a style off and by a playback.
class LiveStylizer {
 public:
  // Fails with a message if a time option is out of range, or if `max_lead` is used with a model
  // without a predictor.
  static Result<void> check(const Model& model, const LiveOptions& options);
  // Fails likewise, or if Stylizer::create() fails.
  static Result<LiveStylizer> create(std::shared_ptr<const Model> model, Rig rig,
                                     const LiveOptions& options = {});

  // Forgets the motion so far, including lag, lead and position.
  void reset() noexcept;

  // See Stylizer::step(); `seconds` passed since the last step. Allocates nothing, never fails.
  void step(ConstPose in, std::span<const float> strengths, double seconds, Pose out) noexcept;

  // The remover's style to take off the input first, at the input's tempo; -1 (initially): none.
  // Eased like strengths. Other numbers are ignored.
  void set_removed(int style) noexcept {
    if (removal_) removal_->set_removed(style);
  }

  // Position of the shown input: seconds after the newest pose, negative if it lags, at the last
  // step.
  double ahead() const noexcept { return playback_ ? playback_->ahead() : 0; }
  // Cycles skipped minus cycles repeated since the start.
  int skipped_cycles() const noexcept { return playback_ ? playback_->skipped_cycles() : 0; }
  // Whether the tempo is the input's and no style can be taken off, so that a step only calls the
  // stylizer.
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
  std::unique_ptr<Playback> playback_;  // Null if the tempo is the input's.
  std::optional<RemovalPass> removal_;  // With a remover.
};

}  // namespace panache
