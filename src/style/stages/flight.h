#pragma once
// When the body is in the air. It falls as its input does, whatever the style's
// tempo: see Stylizer::rate().

#include <array>
#include <cstddef>

#include "rig/humanoid.h"

namespace panache {

// Poses pushed this much before they are played show a flight early enough to ease into. Seconds.
inline constexpr double kFlightAhead = 0.6;

// Finds jumps and hops in poses as they come: times at which no foot is near the floor and the body
// falls freely. The flights of a run are too short to count, so that its tempo stays even.
class FlightWatch {
 public:
  void reset() noexcept { *this = {}; }
  // `time`: of the input, seconds, never before the last one; `world`: canonical joints, Y up,
  // metres, floor at 0.
  void push(double time, const HumanPositions& world) noexcept;
  // How much of a flight the moment `time` is part of, 0 (the style has its tempo) to 1 (the input
  // has). It eases in before a flight, as far as poses pushed show it coming, and out after the
  // landing. Without lag a flight is detected about 0.15 s after take-off.
  float amount(double time) const noexcept;

  // Calls visit(member) for everything that tells one character from another.
  template <class Self, class Visit>
  static void visit_state(Self& self, Visit&& visit) {
    visit(self.samples_), visit(self.count_), visit(self.judged_), visit(self.flights_);
    visit(self.newest_), visit(self.open_);
  }

 private:
  struct Sample {
    double time = 0;
    float height = 0;  // Of the body's centre, metres.
    float feet = 0;    // Of the lowest foot over where it stands, metres.
  };
  struct Flight {
    double start = 0, end = 0;  // Seconds; none where they are equal.
    double expected = 0;        // Its duration, predicted from the rise at the start.
  };
  // How the body's centre moves up, m/s and m/s^2.
  struct Ballistics {
    double velocity = 0, acceleration = 0;
  };
  void judge(int sample) noexcept;
  Ballistics ballistics(int sample) const noexcept;

  // Poses closer than this to the last are left out: the fit has enough of them.
  static constexpr double kMinGap = 0.008;
  static constexpr int kSamples = 20;

  std::array<Sample, kSamples> samples_{};  // Oldest first.
  int count_ = 0, judged_ = 0;              // How many there are, and were judged.
  std::array<Flight, 12> flights_{};        // In a ring; those of the last seconds.
  size_t newest_ = 0;                       // The newest of them,
  bool open_ = false;                       // which lasts.
};

}  // namespace panache
