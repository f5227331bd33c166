#pragma once
// How a play head goes through a whole clip: flights ahead of it, and where it comes to next.

#include <algorithm>
#include <cmath>

#include "base/elementary.h"
#include "clip/clip.h"
#include "rig/posed_rig.h"
#include "style/stages/flight.h"

namespace panache {

// How many frames a play head at `frame` goes on, which a style asks to go at `rate`. Between two
// frames an impact is a mean of both and loses its edge: where a flight (FlightWatch::amount())
// takes the rate to 1, the head is drawn to whole frames, and stays on those that it is on.
inline double clip_advance(double frame, double rate, float flight) {
  constexpr float kMost = 0.06f, kTurn = 6.2831853f;
  const double next = frame + rate;
  const float share = std::max(0.0f, 2 * flight - 1);
  return rate + static_cast<double>(-kMost * share *
                                    sine(kTurn * static_cast<float>(next - std::round(next))));
}

// The clip outlives it.
class FlightLookout {
 public:
  FlightLookout(const Clip& clip, const Rig& rig)
      : clip_(clip), reader_(rig), next_(rig.first_frame()) {}

  // Goes on from another frame, which may be an earlier one.
  void restart(double frame) {
    const double first = frame - kFlightAhead / clip_.frame_time;
    next_ = static_cast<int>(std::max<double>(reader_.rig().first_frame(), first));
    flights_.reset();
  }
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
