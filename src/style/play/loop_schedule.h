#pragma once
// The path of a play head through a loop, so that each round takes a whole number of frames.

#include <vector>

namespace panache {

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
