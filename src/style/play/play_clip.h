#pragma once
// Plays a whole clip with the changes of a source, at the tempo it requests: restyle() uses a
// model as the source, the laboratory other systems.

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <vector>

#include "base/elementary.h"
#include "clip/clip.h"
#include "rig/posed_rig.h"
#include "style/networks/change_source.h"
#include "style/restyle.h"
#include "style/stages/flight.h"

namespace panache {

// A play head in a clip: the pose there, flights ahead of it, and its next position.

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

// Returns a new, unused source each time.
using MakeSource = std::function<std::unique_ptr<ChangeSource>()>;

// `loop`: the result becomes a loop, unless it is identical to the clip; requires is_loop() or
// check_closable(). LoopMode is ignored. `progress`: see restyle().
Restyled play_clip(const Clip& clip, const Rig& rig, const MakeSource& make_source, bool loop,
                   const RestyleOptions& options, const std::function<void(double)>& progress = {});

// The part of play_clip() for loops: plays a clip repeatedly until the result repeats.
// The result begins at the input's first frame; its last pose equals its first, except for travel;
// see Restyled::loop.
Restyled play_loop(const Clip& clip, const Rig& rig, ChangeSource& source,
                   const RestyleOptions& options, const std::function<void(double)>& progress);

// The requested tempo at one frame of a round.
struct PaceSample {
  double phase = 0;  // Frames of the input since the round began, with fractions.
  double rate = 1;   // Input frames per output frame.
  float flight = 0;  // See FlightWatch::amount().
};

// The phases of the output frames of a round of `length` input frames, from 0 to `length`
// inclusive, at the tempo of `last` (samples of one round in order of phase, at least one). Flights
// keep their tempo; the rest is adjusted minimally so that the number of frames is whole. `frames`:
// the previous round's number, kept if it is within 0.6 of the ideal one; 0 for none.
std::vector<double> loop_schedule(const std::vector<PaceSample>& last, int length, int frames);

}  // namespace panache
