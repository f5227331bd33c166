#pragma once
// Keeps the walker's standing feet in place, and brings the others back under the body.

#include <array>

#include "base/quat.h"
#include "base/vec.h"
#include "walker/drive.h"

namespace panache {

// A leg in the world, metres.
struct Leg {
  Vec3 hip, knee, ankle, toe;
  Quat upper, lower, foot;  // World rotations.
  float height = 0;         // Of the toe above a ground that leans with the body.
};
using Legs = std::array<Leg, 2>;  // Left, right.

class Feet {
 public:
  // Moves the legs from their pose in the gait to where the feet stand. `lead`: how far the body
  // turns during a stance beyond the gait itself, radians.
  void tick(const Drive& drive, const Steps& steps, float lead, float dt, Legs& legs) noexcept;
  // Whether both feet stand, and under the body.
  bool are_settled() const noexcept { return settled_; }
  // How far the hips must sink for the legs to reach the ground, metres; eased.
  float drop() const noexcept { return drop_; }

 private:
  struct Foot {
    bool lifted = false;
    bool known = false;  // `toe` and `yaw` are of the last tick.
    Vec3 toe;            // World, in the gait.
    float yaw = 0;       // Likewise.
    Vec3 offset;         // Horizontal, from `toe` to the foot.
    float twist = 0;     // Likewise for the yaw.
    float swing = 0;     // As in Steps, at the last tick.
    float lift = 0;      // Extra height of this swing, metres.
  };
  // The steps of one foot.
  struct Stepping {
    Vec3 middle;                                          // Of the path, on the ground.
    float lead = 0;                                       // As in tick().
    float amount = 0, swing = 0, stands = 0, stance = 0;  // As in Drive and Steps.
  };
  void step(int f, Leg& leg, const Stepping& now) noexcept;
  static void hold(Foot& foot, const Stepping& now, Vec3 toe, float yaw) noexcept;

  std::array<Foot, 2> feet_;
  bool settled_ = true;
  float drop_ = 0, needed_drop_ = 0;
};

}  // namespace panache
