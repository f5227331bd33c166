#pragma once
// Holds planted feet where they landed, with two-bone inverse kinematics, and lets them creep
// slowly to where a style wants them to stand. Causal: no look-ahead.

#include <array>
#include <span>

#include "base/quat.h"
#include "pose/contacts.h"
#include "rig/humanoid.h"
#include "rig/rig.h"

namespace panache {

// Turns a two-bone chain so that its end reaches for `target`.
struct TwoBoneTurn {
  Quat upper, lower;  // To be applied on top of the upper and the lower joint's world rotation.
};
// `root`, `middle`, `end`: where hip, knee and ankle (or shoulder, elbow, wrist) are; any one
// space. A target beyond reach is approached as far as the chain's length allows. `bend`: to which
// side of the line from root to end the middle goes, of any length; it turns along with that line.
TwoBoneTurn two_bone_ik(Vec3 root, Vec3 middle, Vec3 end, Vec3 target, Vec3 bend) noexcept;
// Where such a chain has its middle and end then. `out`: to which side of the line from root to
// target the middle goes, unit, at a right angle to that line. A chain without length stays.
struct TwoBonePlaces {
  Vec3 middle, end;
};
TwoBonePlaces two_bone_places(Vec3 root, Vec3 middle, Vec3 end, Vec3 target, Vec3 out) noexcept;
TwoBoneTurn two_bone_turn(Vec3 root, Vec3 middle, Vec3 end, const TwoBonePlaces& to) noexcept;
// The side that the middle is on, or that of `hint` where the chain is straight. `firm`: a middle
// that is nearer than twice this to the line from root to end (metres) goes the more towards the
// hint, the nearer it is; two thirds of it on the wrong side do not make the chain bend that way.
Vec3 bend_of(Vec3 root, Vec3 middle, Vec3 end, Vec3 hint, float firm = 0) noexcept;

// Where a knee points: where the foot does, and ahead where that points down. Heading frame.
Vec3 knee_way(Vec3 ankle, Vec3 toe) noexcept;

// Positions of the user's joints with the rotations of `change` on them, in the heading frame of
// the input: origin midway between the hip joints, axes turned so that the body faces +z. Turn and
// translation are left out.
Vec3 mid_hip(const BodyPose& body) noexcept;  // World.
void changed_joints(const BodyPose& body, const BodyChange& change, HumanPositions& out) noexcept;

// The height below which a style should put no toe: the floor, or the input's own lowest toe where
// that is lower. World, metres.
float toe_floor(const BodyPose& body) noexcept;
// How much deeper than that the lowest toe is with `change`; 0 above it. `joints`:
// changed_joints().
float floor_depth(const BodyPose& body, const HumanPositions& joints,
                  const BodyChange& change) noexcept;

class FootLock {
 public:
  // Seconds since the last step: of the input's own time, by which the input's toe leaves or
  // stands, and of the viewer's, in which everything that is shown moves. A style's tempo tells
  // them apart.
  struct Seconds {
    float input, output;
  };
  void reset() noexcept { feet_ = {}; }
  // Adjusts the legs of `change`, and draws toes up that are below toe_floor() as far as the legs
  // can easily see to it. `joints`: changed_joints() of body and change; `contacts`: probability
  // that each foot is planted, 0 to 1; `level`: how much of its height is given already, 0 to 1;
  // `amount`: how much of the correction to apply, 0 (none at all) to 1.
  void step(const BodyPose& body, const HumanPositions& joints,
            std::span<const float, kFeet> contacts, std::span<const float, kFeet> level,
            float amount, Seconds seconds, BodyChange& change) noexcept;

  // Calls visit(member) for everything that tells one foot lock from another.
  template <class Self, class Visit>
  static void visit_state(Self& self, Visit&& visit) {
    visit(self.feet_);
  }

 private:
  // Unseen: before the first step. Let go: slid in the input, free until it lifts.
  enum class State { unseen, free, planted, let_go };
  struct Foot {
    State state = State::unseen;
    Vec3 toe;     // World position of the toe, uncorrected, at the last step,
    Vec3 input;   // and in the input.
    Vec3 stood;   // Where the input's toe was when the foot was planted.
    Vec3 anchor;  // World position of the planted toe, metres,
    Vec3 glide;   // and its velocity while it comes to rest, m/s.
    Vec3 offset;  // World correction in force, metres; fades after release,
    Vec3 speed;   // m/s, without a jump in its velocity.
    Vec3 knee;    // To which side its knee went, heading frame, length 1; 0 if it was not moved.
  };
  // Follows one foot whose toe is at `input`, and at `toe` with the change, uncorrected (world).
  static void follow(Foot& foot, Vec3 input, Vec3 toe, float contact, Seconds time) noexcept;

  // To which side the knee of a leg goes whose foot is moved. `ahead`: where the foot points;
  // `firm`: how much a nearly straight knee goes there, 0 to 1.
  static Vec3 bend(Foot& foot, Vec3 hip, Vec3 knee, Vec3 ankle, Vec3 ahead, float firm,
                   float seconds) noexcept;

  std::array<Foot, kFeet> feet_;
};

}  // namespace panache
