#pragma once
// A gesture on top of the style.

#include "pose/changed_joints.h"
#include "style/gesture.h"
#include "style/shape.h"

namespace panache {

// Turns the upper body of `change` as `gesture` says, as much as `shape` gives each region, and
// moves the hips. Legs keep ankles and feet where they were, or lift them in a hop.
void add_gesture(const GesturePose& gesture, const Shape& shape, const HeadingBody& body,
                 BodyChange& change) noexcept;

// How much a gesture has the feet off the floor, 0 to 1.
float share_lifted(const GesturePose& gesture, const Shape& shape) noexcept;

}  // namespace panache
