#pragma once
// One character being restyled, step by step, while it moves.

#include <memory>
#include <span>

#include "base/prefetch.h"
#include "base/result.h"
#include "style/network_source.h"
#include "style/stepper.h"
#include "style/stylizer_options.h"

namespace panache {

struct CrowdMember;

// One character's memory. create() allocates everything and may fail; step() does neither.
class Stylizer {
 public:
  // `rig` maps the character's skeleton. Fails with a message where an option is out of its range.
  static Result<Stylizer> create(std::shared_ptr<const Model> model, Rig rig,
                                 const StylizerOptions& options = {});

  // Forgets the motion so far: the next step starts afresh, at full strength.
  void reset() noexcept;
  // The same, as after a jump: a gesture that waits still waits.
  void forget_motion() noexcept { stepper_.reset(); }

  // The amounts of the styles from the next step on; eased in. reset() keeps them.
  void set_shape(const Shape& shape) noexcept { source_.set_shape(shape); }

  // Plays a gesture of a style on top of the style, by its strength: as soon as none plays and a
  // foot is down, see GesturePlayer::trigger(). Returns false where the model has no such gesture.
  bool trigger(int style, int gesture) noexcept { return source_.trigger(style, gesture); }

  // Styles one pose of the character. `strengths`: one per style of the model; numbers that are not
  // finite count as 0, all are held within -4 to 4. Poses that are not finite are replaced by the
  // last good one. `in` and `out` may be the same arrays.
  // `clock`, which may be null, is notified of each stage.
  void step(ConstPose in, std::span<const float> strengths, const StepMoment& moment, Pose out,
            StageClock* clock = nullptr) noexcept {
    source_.set_strengths(strengths);
    stepper_.step(in, moment, source_, out, clock);
  }
  // Live: input and output share the clock.
  void step(ConstPose in, std::span<const float> strengths, double seconds, Pose out,
            StageClock* clock = nullptr) noexcept {
    step(in, strengths, {seconds, seconds}, out, clock);
  }

  // The character's memory as bytes, to go back to a moment (rollback, rewind): after restore() the
  // next step gives what it gave after save(), bit for bit, on a stylizer of the same model,
  // skeleton and options, and on the same kind of machine. Neither allocates.
  size_t state_size() const noexcept;
  // out.size() = state_size().
  void save(std::span<std::byte> out) const noexcept;
  // Returns false, and leaves the stylizer alone, where `in` is no whole state of such a stylizer.
  bool restore(std::span<const std::byte> in) noexcept;

  // Input seconds per output second that style and shape ask for at the last step; 1 without a
  // style, while the body is in the air, because it falls as its input does, and where the feet
  // stand, see StylizerOptions::tempo_everywhere.
  double rate() const noexcept { return stepper_.rate(); }
  // How much any style is in force: 0 without one, 1 from a quarter strength on; at the last step.
  float amount() const noexcept { return source_.amount(); }
  // See StyleNetworks::gate(); smoothed, at the last step.
  float gate() const noexcept { return source_.gate(); }
  // Probability that each foot is planted, at the last step.
  std::span<const float, kFeet> contacts() const noexcept { return stepper_.contacts(); }
  // The change of the input at the last step.
  const BodyChange& change() const noexcept { return stepper_.change(); }
  // What a gesture adds at the last step; null for nothing.
  const GesturePose* gesture() const noexcept { return source_.gesture(); }
  const Rig& rig() const noexcept { return stepper_.rig(); }
  const Model& model() const noexcept { return source_.model(); }

 private:
  template <class Self, class Visit>
  static void visit_state(Self& self, Visit&& visit);

  Stylizer(std::shared_ptr<const Model> model, Rig rig, const StylizerOptions& options);

  friend void step_crowd(std::span<const CrowdMember> members, double seconds) noexcept;
  // Names what a step reads and writes, but for the poses of the window.
  void add_memory(Prefetch& prefetch) const noexcept;

  Stepper stepper_;
  NetworkSource source_;
};

}  // namespace panache
