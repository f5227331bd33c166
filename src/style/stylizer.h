#pragma once
// Restyles one character live, step by step, or many together.

#include <memory>
#include <span>

#include "base/prefetch.h"
#include "base/result.h"
#include "style/networks/network_source.h"
#include "style/stages/step_time.h"
#include "style/stepper.h"
#include "style/stylizer_options.h"

namespace panache {

struct CrowdMember;

// One character's memory. create() allocates everything and may fail; step() does neither.
class Stylizer {
 public:
  // `rig` maps the character's skeleton. Fails with a message if an option is out of range.
  static Result<Stylizer> create(std::shared_ptr<const Model> model, Rig rig,
                                 const StylizerOptions& options = {});

  // Forgets the motion so far: the next step starts afresh, at full strength.
  void reset() noexcept;
  // The same after a jump, but keeps a waiting gesture.
  void forget_motion() noexcept { stepper_.reset(); }

  // The shape from the next step on; eased in. reset() keeps it.
  void set_shape(const Shape& shape) noexcept { source_.set_shape(shape); }

  // The side of a style from the next step on: 1 as captured, which it is at first, -1 mirrored, 0
  // symmetric; clamped, and eased in. reset() keeps it. An index out of range, a side that is not
  // finite and, in a model without a head per style, all sides are ignored.
  void set_side(int style, float side) noexcept { source_.set_side(style, side); }

  // The person from the next step on, in addition to the styles: a number for each axis of the
  // model's persons, see PersonNumbers; clamped to -kMaxPerson to kMaxPerson, and eased in. reset()
  // keeps it. Numbers that are not finite and, in a model without persons, all are ignored.
  void set_person(std::span<const float> numbers) noexcept { source_.set_person(numbers); }
  // As set. Sides are [styles].
  const PersonNumbers& person() const noexcept { return source_.person(); }
  const Shape& shape() const noexcept { return source_.shape(); }
  const std::vector<float>& sides() const noexcept { return source_.sides(); }

  // See StylizerOptions; from the next step on.
  void set_gesture_rate(float rate) noexcept { source_.set_gesture_rate(rate); }
  void set_tempo_everywhere(bool everywhere) noexcept { stepper_.set_tempo_everywhere(everywhere); }

  // Plays a gesture of a style, scaled by its strength, as soon as no other plays and a foot is
  // down, see GesturePlayer::trigger(). Returns false if the model has no such gesture.
  bool trigger(int style, int gesture) noexcept { return source_.trigger(style, gesture); }

  // Styles one pose of the character. `strengths`: one per style of the model; numbers that are not
  // finite count as 0, others are clamped to -4 to 4. Poses that are not finite are replaced by the
  // last good one. `in` and `out` may be the same arrays. `clock`, which may be null, is notified
  // of each stage.
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

  // The character's memory as bytes, for rollback or rewind: after restore() the next step gives
  // the same result as after save(), bit for bit, on a stylizer of the same model, skeleton and
  // options, and on the same kind of machine. Neither allocates.
  size_t state_size() const noexcept;
  // out.size() = state_size().
  void save(std::span<std::byte> out) const noexcept;
  // Returns false and changes nothing if `in` is not a valid state of such a stylizer.
  bool restore(std::span<const std::byte> in) noexcept;

  // Input seconds per output second requested by style and shape at the last step; 1 without a
  // style, while the body is in free fall, and while the feet stand, see
  // StylizerOptions::tempo_everywhere.
  double rate() const noexcept { return stepper_.rate(); }
  // How active any style is at the last step: 0 without one, 1 from a quarter strength on.
  float amount() const noexcept { return source_.amount(); }
  // See StyleNetworks::gate(); smoothed, at the last step.
  float gate() const noexcept { return source_.gate(); }
  // Probability that each foot is planted, at the last step.
  std::span<const float, kFeet> contacts() const noexcept { return stepper_.contacts(); }
  // The change of the input at the last step.
  const BodyChange& change() const noexcept { return stepper_.change(); }
  // What a gesture adds at the last step; null if none plays.
  const GesturePose* gesture() const noexcept { return source_.gesture(); }
  const Rig& rig() const noexcept { return stepper_.rig(); }
  const Model& model() const noexcept { return source_.model(); }

 private:
  template <class Self, class Visit>
  static void visit_state(Self& self, Visit&& visit);

  Stylizer(std::shared_ptr<const Model> model, Rig rig, const StylizerOptions& options);

  friend void step_crowd(std::span<const CrowdMember> members, double seconds) noexcept;
  // Adds the memory that a step uses, except for the poses of the window.
  void add_memory(Prefetch& prefetch) const noexcept;

  Stepper stepper_;
  NetworkSource source_;
};

// One character's part in a step of many; the arguments of Stylizer::step().
struct CrowdMember {
  Stylizer* character;
  ConstPose in;
  std::span<const float> strengths;
  Pose out;
};

// Steps every member by `seconds`, with results identical to separate steps. Fastest if characters
// of one model are adjacent. A character that occurs twice is stepped twice, in order. A member's
// `out` may be the same as its `in`, but must not overlap another's. Allocates nothing, never
// fails; uses about 200 KB of stack.
void step_crowd(std::span<const CrowdMember> members, double seconds) noexcept;

}  // namespace panache
