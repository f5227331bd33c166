#pragma once
// How a play head goes through a loop so that each round takes a whole number of frames.

#include <vector>

namespace panache {

// The requests to a play head at one frame of its round.
struct PaceSample {
  double phase = 0;  // Frames of the input since the round began, with fractions.
  double rate = 1;   // Input frames per output frame.
  float flight = 0;  // See FlightWatch::amount().
};

// The phases of the output frames of a round of `length` input frames at the pace of `last`, a
// round's samples in order of phase, one at least: from 0 to `length`, both among them. The tempo
// is the same in flights and else adjusted by as little as makes the frames whole. `frames`: how
// many steps the round before had, which is kept where it is within 0.6 of the right one; 0 for
// none.
std::vector<double> loop_schedule(const std::vector<PaceSample>& last, int length, int frames);

}  // namespace panache
