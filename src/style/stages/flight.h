#pragma once
// Detects when the body is in the air, where it falls as its input does, at its input's tempo: see
// Stylizer::rate().

#include <array>
#include <cstddef>

#include "rig/humanoid.h"
#include "style/stages/step_time.h"

namespace panache {

// Pushing poses this long before they are played shows a flight early enough to ease in. Seconds.
inline constexpr double kFlightAhead = 0.6;

// Detects jumps and hops in a stream of poses: times with no foot near the floor and the body in
// free fall. The flights of a run are too short to count, so that its tempo stays even.
class FlightWatch {
 public:
  void reset() noexcept { *this = {}; }
  // `time`: of the input, seconds, never before the last one; `world`: canonical joints, Y up,
  // metres, floor at 0.
  void push(double time, const HumanPositions& world) noexcept;
  // How much the moment `time` belongs to a flight, 0 (the style's tempo) to 1 (the input's). It
  // eases in before a flight, as far as it is visible in the pushed poses, and out after the
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
    float feet = 0;    // Of the lowest foot above its standing height, metres.
  };
  struct Flight {
    double start = 0, end = 0;  // Seconds; none if they are equal.
    double expected = 0;        // Its duration, predicted from the rise at the start.
  };
  // Upward motion of the body's centre, m/s and m/s^2.
  struct Ballistics {
    double velocity = 0, acceleration = 0;
  };
  void judge(int sample) noexcept;
  Ballistics ballistics(int sample) const noexcept;

  // Poses closer than this to the last are skipped: the fit does not need them.
  static constexpr double kMinGap = 0.008;
  static constexpr int kSamples = 20;

  std::array<Sample, kSamples> samples_{};  // Oldest first.
  int count_ = 0, judged_ = 0;              // The numbers of samples and of evaluated ones.
  std::array<Flight, 12> flights_{};        // A ring of the last seconds' flights.
  size_t newest_ = 0;                       // The newest of them; `open_`: it is
  bool open_ = false;                       // still in progress.
};

// In the air, a style's change of the height keeps its value at take-off, so that the body rises
// and falls like its input; on the ground the height returns to the style's.
class FreeFall {
 public:
  void reset() noexcept { *this = {}; }
  // `flight`: see FlightWatch::amount(). Adjusts the height of `change`.
  void step(float flight, const StepTime& time, BodyChange& change) noexcept;

  // Calls visit(member) for everything that tells one character from another.
  template <class Self, class Visit>
  static void visit_state(Self& self, Visit&& visit) {
    visit(self.wanted_), visit(self.held_);
  }

 private:
  float wanted_ = 0;  // The height that the style asks for at the last step, metres;
  float held_ = 0;    // what is added to it.
};

}  // namespace panache
