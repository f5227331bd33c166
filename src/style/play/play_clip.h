#pragma once
// Plays a whole clip with the changes of a source, at the tempo it requests: restyle() uses a
// model as the source, the laboratory other systems.

#include <functional>
#include <memory>
#include <vector>

#include "style/networks/change_source.h"
#include "style/restyle.h"

namespace panache {

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
