#pragma once
// One character being restyled, step by step, while it moves.

#include <memory>
#include <span>
#include <vector>

#include "base/result.h"
#include "pose/foot_lock.h"
#include "pose/history.h"
#include "rig/rig.h"
#include "style/model.h"

namespace panache {

struct CrowdMember;

struct StylizerOptions {
  float ease_seconds = 0.15f;  // A change of strength takes about this long to arrive.
  float smoothing_seconds =
      0.04f;  // Time constant of the filter on the change, never on the input.
  bool foot_lock = true;
  bool root = true;  // Style the way over the ground, not only the pose.
};

// One character's memory. create() allocates everything and may fail; step() does neither.
class Stylizer {
 public:
  // `rig` maps the character's skeleton; the stylizer keeps its own copy. Fails with a sentence
  // where an option is out of its range.
  static Result<Stylizer> create(std::shared_ptr<const Model> model, Rig rig,
                                 const StylizerOptions& options = {});

  // Forgets the motion so far: the next step starts afresh, at full strength.
  void reset() noexcept;

  // Styles one pose of the character. `strengths`: one per style of the model; numbers that are not
  // finite count as 0, all are held within -4 to 4. `input_seconds`: how much of the input's own
  // time passed since the last step; `output_seconds`: how much of the viewer's. They are the same
  // unless a play head runs through the input at another rate. Poses that are not finite are
  // replaced by the last good one. `in` and `out` may be the same arrays.
  void step(ConstPose in, std::span<const float> strengths, double input_seconds,
            double output_seconds, Pose out) noexcept;
  // Live: input and output share the clock.
  void step(ConstPose in, std::span<const float> strengths, double seconds, Pose out) noexcept {
    step(in, strengths, seconds, seconds, out);
  }

  // The character's memory as bytes, to go back to a moment (rollback, rewind): after restore() the
  // next step gives what it gave after save(), bit for bit, on a stylizer of the same model,
  // skeleton and options, and on the same kind of machine. Neither allocates.
  size_t state_size() const noexcept;
  // out.size() = state_size().
  void save(std::span<std::byte> out) const noexcept;
  // Returns false, and leaves the stylizer alone, where `in` is no whole state of such a stylizer.
  bool restore(std::span<const std::byte> in) noexcept;

  // Input seconds per output second that the style asks for at the last step; 1 without a style.
  double rate() const noexcept { return static_cast<double>(exponential(log_rate_)); }
  // How much any style is in force: 0 without one, 1 from a quarter strength on; at the last step.
  float amount() const noexcept { return amount_; }
  // See StyleNetworks::gate(); smoothed, at the last step.
  float gate() const noexcept { return networks_.gate(); }
  // Probability that each foot is planted, at the last step.
  std::span<const float> contacts() const noexcept { return networks_.contact(); }
  // The canonical body as it was read, and what was done to it, at the last step.
  const BodyPose& body() const noexcept { return body_; }
  const BodyChange& change() const noexcept { return change_; }
  const Rig& rig() const noexcept { return rig_; }
  const Model& model() const noexcept { return networks_.model(); }

 private:
  template <class Self, class Visit>
  static void visit_state(Self& self, Visit&& visit);

  Stylizer(std::shared_ptr<const Model> model, Rig rig, const StylizerOptions& options);

  // A step is three parts, so that a crowd's networks can be evaluated together in the middle.
  friend void step_crowd(std::span<const CrowdMember> members, double seconds) noexcept;
  struct Times {
    double input = 0;      // Seconds of the input,
    float output = 0;      // and of the viewer.
    float gate_share = 1;  // See StyleNetworks::forward().
  };
  // Takes a pose in and fills the window.
  Times look(ConstPose in, std::span<const float> strengths, double input_seconds,
             double output_seconds) noexcept;
  // Puts on `out` what the networks answered to the window.
  void change_pose(const Times& times, Pose out) noexcept;

  void ease_strengths(std::span<const float> strengths, float seconds) noexcept;
  void take_answer(float seconds) noexcept;
  float forward_speed() const noexcept;  // Mean of the window, m/s; below zero backwards.
  void move_root(double input_seconds) noexcept;
  void keep_above_floor(const HumanPositions& joints, float seconds) noexcept;

  Rig rig_;
  StyleNetworks networks_;
  StylizerOptions options_;

  std::vector<Quat> rotations_;     // The input as taken: finite. [joints]
  std::vector<Vec3> translations_;  // [joints]
  std::vector<float> window_;
  std::vector<float> strengths_;  // In force, eased. [styles]
  float amount_ = 0;              // See amount().

  bool started_ = false;
  double time_ = 0;  // Input seconds since the start.
  PoseHistory history_;
  BodyPose body_;
  Ground ground_, last_ground_;
  HumanPositions seen_;                             // The canonical body in the body frame.
  std::array<float, StyleDelta::kSize> numbers_{};  // Packed.
  float log_rate_ = 0;
  Vec3 drift_;      // What the style added to the way over the ground; world, metres.
  float sway_ = 0;  // And to its left, metres,
  float turn_ = 0;  // and to the heading, radians; both fade.
  float lift_ = 0;  // What keeps the feet above the floor, metres.
  BodyChange change_;
  FootLock foot_lock_;
};

}  // namespace panache
