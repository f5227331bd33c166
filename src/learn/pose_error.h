#pragma once
// The distance of a pose from that of a real styled take.

#include "learn/take.h"
#include "pose/style_delta.h"

namespace panache {

struct PoseError {
  double degrees = 0;  // Mean over joints of the angle between local rotations.
  double cm = 0;       // Mean over joints of the distance on the canonical body, body frame.
};

// The remaining distance between the neutral take at frame `at`, with `change` on it, and frame
// `frame` of the styled take. Both takes are of one character; root motion is not compared.
PoseError pose_error(const Take& styled, int frame, const Take& neutral, float at,
                     const StyleDelta& change);

}  // namespace panache
