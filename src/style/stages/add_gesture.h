#pragma once
// Adds a gesture to the style's change.

#include "pose/changed_joints.h"
#include "style/model/gesture.h"
#include "style/stages/shape.h"

namespace panache {

// Applies `gesture` to the upper body and hips of `change`, weighted per region by `shape`. Legs
// keep ankles and feet in place, or lift them in a hop.
void add_gesture(const GesturePose& gesture, const Shape& shape, const HeadingBody& body,
                 BodyChange& change) noexcept;

// How far a gesture lifts both feet, metres, and whether that takes them off the floor, 0 to 1.
float gesture_lift(const GesturePose& gesture, const Shape& shape) noexcept;
float share_lifted(float lift) noexcept;

}  // namespace panache
