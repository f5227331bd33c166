#pragma once
// Converts the change to one of the body, in the amounts of the shape.

#include <array>

#include "base/quat.h"
#include "pose/style_delta.h"
#include "rig/humanoid.h"
#include "style/model/predictor_network.h"
#include "style/stages/root_motion.h"
#include "style/stages/shape.h"
#include "style/stages/step_time.h"

namespace panache {

// Applies a style's change to a body.

// World rotation that the change applies to a joint, in the heading frame.
Quat joint_rotation(const StyleDelta& change, int joint) noexcept;
// The same for all joints.
std::array<Quat, kHumanJoints> joint_rotations(const StyleDelta& change) noexcept;

// The canonical body (body frame, metres) with the change's rotations and hips height.
HumanPositions change_body(const HumanPositions& body, const StyleDelta& change) noexcept;

// The change from the body `before` to the body `after`, both canonical.
BodyChange change_between(const PredictedPose& before, const PredictedPose& after) noexcept;

// Has no effect at all while the shape is Shape{}.
class Shaping {
 public:
  void reset() noexcept { *this = {}; }
  // Writes `delta` and `root`, shaped, as a change of the body; returns the shaped root motion.
  RootOffset step(const Shape& shape, const StyleDelta& delta, const RootOffset& root,
                  const StepTime& time, BodyChange& out) noexcept;

  // Calls visit(member) for everything that tells one character from another.
  template <class Self, class Visit>
  static void visit_state(Self& self, Visit&& visit) {
    visit(self.mean_rotations_), visit(self.mean_height_), visit(self.last_), visit(self.held_);
  }

 private:
  RootOffset hold_back(const Shape& shape, const RootOffset& root, const StepTime& time) noexcept;
  StyleDelta weigh_in_time(const Shape& shape, const StyleDelta& delta,
                           const StepTime& time) noexcept;

  std::array<Vec3, kHumanJoints> mean_rotations_{};  // As in StyleDelta.
  float mean_height_ = 0;                            // Metres.
  RootOffset last_;                                  // As requested at the last step.
  RootOffset held_;                                  // The part of it that was held back.
};

}  // namespace panache
