#pragma once
// A play head in a clip: the pose there, flights ahead of it, and its next position.

#include <algorithm>
#include <cmath>

#include "base/elementary.h"
#include "clip/clip.h"
#include "rig/posed_rig.h"
#include "style/stages/flight.h"

namespace panache {

// How many frames a play head at `frame` advances if a style requests `rate`. Interpolation between
// frames blurs an impact: in a flight (FlightWatch::amount()), which brings the rate to 1, the head
// is drawn to whole frames.
inline double clip_advance(double frame, double rate, float flight) {
  constexpr float kMax = 0.06f, kTurn = 6.2831853f;
  const double next = frame + rate;
  const float share = std::max(0.0f, 2 * flight - 1);
  return rate + static_cast<double>(-kMax * share *
                                    sine(kTurn * static_cast<float>(next - std::round(next))));
}

// The clip must outlive it.
class ClipHead {
 public:
  ClipHead(const Clip& clip, const Rig& rig)
      : clip_(clip), reader_(rig), next_(rig.first_frame()) {}

  // Continues from another frame, possibly an earlier one.
  void restart(double frame) {
    const double first = frame - kFlightAhead / clip_.frame_time;
    next_ = static_cast<int>(std::max<double>(reader_.rig().first_frame(), first));
    flights_.reset();
  }
  // Writes the pose at `frame`, which is fractional and never goes back, and returns
  // FlightWatch::amount() there.
  float show(double frame, Pose out) {
    sample(clip_, frame, out);
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
