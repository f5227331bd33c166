#pragma once
// Plays gestures, triggered or at random, and adds them to the style's change.

#include <cstdint>
#include <span>

#include "base/random.h"
#include "pose/changed_joints.h"
#include "style/model/gesture.h"
#include "style/model/model.h"
#include "style/stages/shape.h"
#include "style/stages/step_time.h"

namespace panache {

// Plays one gesture at a time. It starts when a foot is down, never while the body is in the air.
// At random the active styles play theirs as often as their takes do (Model::gesture_rate()), up to
// strength 1 in proportion to it. If that is r per second, they are 0.5 / r to 1.5 / r seconds
// apart.
class GesturePlayer {
 public:
  explicit GesturePlayer(uint32_t seed) : random_(seed) {}

  void reset(uint32_t seed) noexcept { *this = GesturePlayer(seed); }
  // Ends the playing gesture at once, as after a jump.
  void stop() noexcept { style_ = -1; }

  // Requests a gesture, which must be in the model. It waits for a playing gesture and for a foot
  // on the floor, at most kPatience, and replaces another waiting gesture.
  void trigger(int style, int gesture) noexcept;

  // Conditions for starting a gesture.
  struct Ground {
    bool holds_body = true;  // A foot is down, or something else holds the body.
    bool holds_feet = true;  // A foot is planted, and the body does not sit.
    float flight = 0;        // See FlightWatch::amount().
    float run = 0;           // 0 (walk) to 1 (run, where dips of the hips fling the knees).
  };
  // `strengths` and `sides`: [styles], eased; `often`: times as many random gestures as in the
  // takes, 0 for none.
  void step(const Model& model, std::span<const float> strengths, std::span<const float> sides,
            float often, const Ground& ground, const StepTime& time) noexcept;

  // Whether no gesture plays or waits.
  bool rests() const noexcept { return style_ < 0 && next_style_ < 0; }

  // What it adds at the last step, by the strength and the side of its style; null for nothing.
  const GesturePose* now() const noexcept { return style_ >= 0 ? &pose_ : nullptr; }

  static constexpr float kPatience = 3;  // Seconds.
  static constexpr float kMaxOften = 10;

  // Calls visit(member) for everything that tells one character from another.
  template <class Self, class Visit>
  static void visit_state(Self& self, Visit&& visit) {
    visit(self.style_), visit(self.gesture_), visit(self.time_), visit(self.pose_);
    visit(self.next_style_), visit(self.next_gesture_), visit(self.waited_);
    visit(self.random_), visit(self.due_), visit(self.begun_);
  }

 private:
  void draw(const Model& model, std::span<const float> strengths, float often,
            float seconds) noexcept;
  void start(const Model& model, std::span<const float> strengths, const Ground& ground,
             float seconds) noexcept;

  int32_t style_ = -1, gesture_ = 0;  // Playing; -1 for none,
  float time_ = 0;                    // since so many seconds.
  GesturePose pose_;
  int32_t next_style_ = -1, next_gesture_ = 0;  // Waiting; -1 for none,
  float waited_ = 0;                            // since so many seconds.
  Random random_;
  float due_ = -1;      // Mean intervals until the next random one; negative: not drawn yet.
  bool begun_ = false;  // Whether a random one has been drawn.
};

// Applies `gesture` to the upper body and hips of `change`, weighted per region by `shape`. Legs
// keep ankles and feet in place, or lift them in a hop.
void add_gesture(const GesturePose& gesture, const Shape& shape, const HeadingBody& body,
                 BodyChange& change) noexcept;

// How far a gesture lifts both feet, metres, and whether that takes them off the floor, 0 to 1.
float gesture_lift(const GesturePose& gesture, const Shape& shape) noexcept;
float share_lifted(float lift) noexcept;

}  // namespace panache
