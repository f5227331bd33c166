#pragma once
// Takes a style off a motion, of a clip or live: a first pass with the remover, a model trained
// on reversed pairs, makes it neutral; a second pass may put another style on.

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "style/restyle.h"
#include "style/stylizer.h"

namespace panache {

// Whether a model takes its styles off instead of putting them on (kDirection in model.h).
bool is_remover(const Model& model);

// The remover's index of the style to take off; "" means kAnyStyle, for motion in an unknown style.
// Fails if `remover` puts styles on, or with the nearest names if the name is unknown.
Result<int> find_removal(const Model& remover, std::string_view style);

// What to take off.
struct Removal {
  std::shared_ptr<const Model> remover;
  int style = 0;  // Index in the remover.
};

// Takes the style off the clip, then calls restyle(). Shape, sides and tracks apply to the styles
// that are put on; times are seconds of the clip. With all strengths at 0 the result is the neutral
// motion.
Result<Restyled> restyle_without(const Clip& clip, const Rig& rig, const Removal& removal,
                                 const std::shared_ptr<const Model>& model,
                                 const std::vector<StrengthTrack>& tracks,
                                 const RestyleOptions& options = {},
                                 const std::function<void(double)>& progress = {});

class RemovalPass {
 public:
  // `options`: all but shape and sides is used. Fails if `remover` puts styles on, or if
  // Stylizer::create() fails.
  static Result<RemovalPass> create(std::shared_ptr<const Model> remover, Rig rig,
                                    StylizerOptions options);

  // The remover's style to take off; -1 (initially): none. Eased like strengths. Other numbers are
  // ignored.
  void set_removed(int style) noexcept;
  // The input without the style, valid until the next step; times as for Stylizer::step().
  ConstPose step(ConstPose in, double input_seconds, double output_seconds) noexcept;

  // See Stylizer; the style to take off is not part of the state.
  void set_tempo_everywhere(bool all) noexcept { stylizer_.set_tempo_everywhere(all); }
  void reset() noexcept { stylizer_.reset(); }
  const Stylizer& stylizer() const noexcept { return stylizer_; }
  size_t state_size() const noexcept { return stylizer_.state_size(); }
  void save(std::span<std::byte> out) const noexcept { stylizer_.save(out); }
  bool restore(std::span<const std::byte> in) noexcept { return stylizer_.restore(in); }

 private:
  explicit RemovalPass(Stylizer stylizer);

  Stylizer stylizer_;
  std::vector<float> strengths_;    // [styles of the remover]
  std::vector<Quat> rotations_;     // The neutral pose. [joints]
  std::vector<Vec3> translations_;  // Likewise.
};

}  // namespace panache
