#pragma once
// One character being restyled, step by step, while it moves.

#include <array>
#include <memory>
#include <optional>
#include <span>

#include "base/prefetch.h"
#include "base/result.h"
#include "pose/observer.h"
#include "style/model.h"
#include "style/shape.h"
#include "style/stage_clock.h"
#include "style/stages/change_stages.h"
#include "style/stages/flight.h"
#include "style/stages/gesture_player.h"
#include "style/stages/strengths.h"
#include "style/stages/window.h"

namespace panache {

struct CrowdMember;

struct StylizerOptions {
  // A change of strength or shape takes about this long to arrive.
  float ease_seconds = 0.15f;
  // Time constant of the filter on the change, never on the input; see OutputFilter.
  float smoothing_seconds = 0.04f;
  bool foot_lock = true;
  bool root = true;  // Style the root motion, not only the pose.
  // The style's tempo also where the feet stand; otherwise such motion keeps its input's time.
  bool tempo_everywhere = false;
  Shape shape;  // At first, see Stylizer::set_shape().
  // Hips that are faster over the ground, m/s, have jumped, and the past is forgotten. Bodies on
  // vehicles need more; infinity: nothing is a jump.
  float max_speed = Observer::kMaxGroundSpeed;
  // Gestures of the styles in force, thrown in at random: so many per second, 0 to
  // GesturePlayer::kMaxRate. Characters with different seeds play them at different times.
  float gesture_rate = 0;
  uint32_t gesture_seed = 0;
};

// When a pose is: how much of the input's own time passed since the last step, and how much of the
// viewer's. They are the same unless a play head runs through the input at another rate.
struct StepMoment {
  double input_seconds, output_seconds;
  // How much of a flight the pose is part of, see FlightWatch::amount(), where a play head has seen
  // poses to come. Otherwise the poses so far tell.
  std::optional<float> flight = {};
};

// One character's memory. create() allocates everything and may fail; step() does neither.
class Stylizer {
 public:
  // `rig` maps the character's skeleton. Fails with a message where an option is out of its range.
  static Result<Stylizer> create(std::shared_ptr<const Model> model, Rig rig,
                                 const StylizerOptions& options = {});

  // Forgets the motion so far: the next step starts afresh, at full strength.
  void reset() noexcept;
  // The same, as after a jump: a gesture that waits still waits.
  void forget_motion() noexcept;

  // The amounts of the styles from the next step on; eased in. reset() keeps them.
  void set_shape(const Shape& shape) noexcept { shape_ = shape; }

  // Plays a gesture of a style on top of the style, by its strength: as soon as none plays and a
  // foot is down, see GesturePlayer::trigger(). Returns false where the model has no such gesture.
  bool trigger(int style, int gesture) noexcept;

  // Styles one pose of the character. `strengths`: one per style of the model; numbers that are not
  // finite count as 0, all are held within -4 to 4. Poses that are not finite are replaced by the
  // last good one. `in` and `out` may be the same arrays.
  void step(ConstPose in, std::span<const float> strengths, const StepMoment& moment,
            Pose out) noexcept;
  // Live: input and output share the clock.
  void step(ConstPose in, std::span<const float> strengths, double seconds, Pose out) noexcept {
    step(in, strengths, {seconds, seconds}, out);
  }
  // The same; `clock` is notified of each stage.
  void step(ConstPose in, std::span<const float> strengths, double seconds, Pose out,
            StageClock& clock) noexcept;

  // Before the first step of a motion whose second pose is known: the first step then knows whether
  // the body moves. Later steps do not need it.
  void set_next(ConstPose next, double seconds) noexcept;

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
  double rate() const noexcept;
  // How much any style is in force: 0 without one, 1 from a quarter strength on; at the last step.
  float amount() const noexcept { return strengths_.amount(); }
  // In force at the last step. [styles]
  std::span<const float> strengths() const noexcept { return strengths_.now(); }
  // See StyleNetworks::gate(); smoothed, at the last step.
  float gate() const noexcept { return networks_.gate(); }
  // Probability that each foot is planted, at the last step.
  std::span<const float, kFeet> contacts() const noexcept { return stages_.contacts(); }
  // The change of the input at the last step.
  const BodyChange& change() const noexcept { return stages_.change(); }
  // What a gesture adds at the last step; null for nothing.
  const GesturePose* gesture() const noexcept { return gestures_.now(); }
  // The facts of the stages at the last step.
  StageFacts stage_facts() const noexcept { return stages_.facts(); }
  const Rig& rig() const noexcept { return observer_.rig(); }
  const Model& model() const noexcept { return networks_.model(); }

 private:
  template <class Self, class Visit>
  static void visit_state(Self& self, Visit&& visit);

  Stylizer(std::shared_ptr<const Model> model, Rig rig, const StylizerOptions& options);

  // A step is three parts, so that a crowd's networks can be evaluated together in the middle.
  // `clock` may be null.
  friend void step_crowd(std::span<const CrowdMember> members, double seconds) noexcept;
  struct TakenIn {
    StepTime time;
    StyleNetworks::Pass pass;
  };
  // `room`: where the window is written, InputWindow::kMaxNumbers.
  TakenIn take_in(ConstPose in, std::span<const float> strengths, const StepMoment& moment,
                  std::span<float> room, StageClock* clock) noexcept;
  void step(ConstPose in, std::span<const float> strengths, const StepMoment& moment, Pose out,
            StageClock* clock) noexcept;
  // Names what a step reads and writes, but for the poses of the window.
  void add_memory(Prefetch& prefetch) const noexcept;
  void forget() noexcept;  // Of the motion so far, all but the observer's part.
  void give_out(const StepTime& time, Pose out, StageClock* clock) noexcept;
  GesturePlayer::Ground ground() const noexcept;

  StylizerOptions options_;
  Shape shape_;  // As asked for.
  bool started_ = false;

  // The stages.
  Observer observer_;
  EasedStrengths strengths_;
  InputWindow window_;
  StyleNetworks networks_;
  ChangeStages stages_;
  GesturePlayer gestures_;
  FlightWatch flights_;
  float flight_ = 0;  // Of FlightWatch::amount(), at the last step.
  NextPose next_;     // By set_next(), for the first step; no time for none.
};

}  // namespace panache
