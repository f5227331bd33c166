#pragma once
// A stylizer with its change taken apart: how much of the posture, of the dynamics, and of which
// part of the body.

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "base/result.h"
#include "pose/foot_lock.h"
#include "rig/rig.h"
#include "style/stylizer.h"

namespace panache::web {

// Parts of the body that can be left as the input has them, relative to what they hang on.
enum Region { kLegs, kSpine, kArms, kHead, kRegions };

// How much of a style is given; with all at 1 a character is what a Stylizer makes of it, bit for
// bit. Numbers are held within 0 to 2.
struct Shape {
  float posture = 1;   // Of the lasting part of the change: its mean over the last second or so.
  float dynamics = 1;  // Of what the change is beyond that, and of the way over the ground.
  float timing = 1;    // Of the logarithm of the rate.
  std::array<float, kRegions> regions = {1, 1, 1, 1};  // Legs: with hips, height and way.
  float foot_lock = 1;
};

// One character's memory. create() allocates everything and may fail; step() does neither.
class Character {
 public:
  static Result<Character> create(std::shared_ptr<const Model> model, const Rig& rig);

  // Forgets the motion so far: the next step starts afresh, at full strength.
  void reset() noexcept;
  // As Stylizer::step, with all that is asked for eased in over 0.15 s. `in` is finite, and no part
  // of `out`.
  void step(ConstPose in, std::span<const float> strengths, const Shape& shape,
            double input_seconds, double output_seconds, Pose out) noexcept;

  // Input seconds per output second that style and shape ask for at the last step.
  double rate() const noexcept;
  // Probability that each foot is planted, at the last step.
  std::span<const float> contacts() const noexcept { return stylizer_.contacts(); }
  // How much of the styles' answer is given, 0 to 1: see Stylizer::gate().
  float gate() const noexcept { return stylizer_.gate(); }
  // In force at the last step. [styles]
  std::span<const float> strengths() const noexcept { return strengths_; }
  const Rig& rig() const noexcept { return rig_; }

 private:
  Character(Stylizer stylizer, const Rig& rig);

  void ease(std::span<const float> strengths, const Shape& shape, float seconds) noexcept;
  void weigh_in_time(float seconds, BodyChange& change) noexcept;
  void weigh_regions(BodyChange& change) const noexcept;
  void hold_back_way(BodyChange& change) noexcept;

  Stylizer stylizer_;  // Without foot lock and easing, which come after the shape here.
  Rig rig_;
  FootLock foot_lock_;
  bool started_ = false;
  std::vector<float> strengths_;  // Eased. [styles]
  float amount_ = 0;              // As the stylizer's: 0 without any style, 1 from a quarter on.
  Shape shape_;                   // Eased.
  BodyPose body_;
  std::array<Vec3, kHumanJoints> mean_turns_{};  // Rotation vectors, heading frame.
  float mean_height_ = 0;                        // Metres.
  BodyChange last_;                              // The stylizer's, at the last step.
  Vec3 held_way_;                                // What was not given of the way, world, metres,
  float held_turn_ = 0;                          // and of the turn, radians.
  float lift_ = 0;  // Beyond the stylizer's, to keep toes above the floor, metres.
};

}  // namespace panache::web
