#pragma once
// Looks for flights ahead of a play head that goes through a whole clip.

#include "clip/clip.h"
#include "rig/posed_rig.h"
#include "style/stages/flight.h"

namespace panache {

// The clip outlives it.
class FlightLookout {
 public:
  FlightLookout(const Clip& clip, const Rig& rig)
      : clip_(clip), reader_(rig), next_(rig.first_frame()) {}

  // See FlightWatch::amount(); `frame` never goes back.
  float flight(double frame) {
    const double until = frame + kFlightAhead / clip_.frame_time;
    for (; next_ < clip_.frames && next_ <= until; ++next_) {
      BodyPose body;
      reader_.read(clip_.pose(next_), body);
      flights_.push(next_ * clip_.frame_time, body.positions);
    }
    return flights_.amount(frame * clip_.frame_time);
  }

 private:
  const Clip& clip_;
  PosedRig reader_;
  FlightWatch flights_;
  int next_;
};

}  // namespace panache
