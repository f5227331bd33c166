#include "style/play/play_clip.h"

#include <algorithm>
#include <cmath>

namespace panache {
namespace {

constexpr double kSameFrames = 0.6;
constexpr float kMaxFit = 1;  // Maximum change of the logarithm of the rate.

// The pace at `phase`, linear between samples, also across the seam.
PaceSample pace_at(const std::vector<PaceSample>& round, double phase, int length) {
  const auto later = std::upper_bound(round.begin(), round.end(), phase,
                                      [](double p, const PaceSample& s) { return p < s.phase; });
  const bool wraps = later == round.end();
  PaceSample a = later == round.begin() ? round.back() : *(later - 1);
  PaceSample b = wraps ? round.front() : *later;
  if (later == round.begin()) a.phase -= length;
  if (wraps) b.phase += length;
  const double t = b.phase > a.phase ? (phase - a.phase) / (b.phase - a.phase) : 0.0;
  return {phase, a.rate + t * (b.rate - a.rate),
          a.flight + static_cast<float>(t) * (b.flight - a.flight)};
}

double advance_at(const std::vector<PaceSample>& round, double phase, int length, float fit) {
  const PaceSample pace = pace_at(round, phase, length);
  const float factor = exponential(fit * (1 - pace.flight));
  return clip_advance(phase, pace.rate * static_cast<double>(factor), pace.flight);
}

// The phases of `frames` steps, from 0 on.
std::vector<double> play(const std::vector<PaceSample>& round, int length, int frames, float fit) {
  std::vector<double> phases = {0};
  for (int i = 0; i < frames; ++i) {
    phases.push_back(phases.back() + advance_at(round, phases.back(), length, fit));
  }
  return phases;
}

// Number of steps in a round, fractional.
double duration(const std::vector<PaceSample>& round, int length) {
  double phase = 0, advance = advance_at(round, 0, length, 0);
  int steps = 0;
  for (; phase + advance < length; ++steps) {
    phase += advance;
    advance = advance_at(round, phase, length, 0);
  }
  return steps + (length - phase) / advance;
}

// Corrects the remaining error of the search: flights go frame by frame and land on whole frames of
// the input; the tempo between them is scaled to fit.
std::vector<double> fit_between_flights(const std::vector<PaceSample>& round, int length,
                                        const std::vector<double>& phases) {
  const size_t steps = phases.size() - 1;
  std::vector<bool> flies;
  for (const double phase : phases) flies.push_back(pace_at(round, phase, length).flight > 0.5f);
  flies[steps] = flies[0];
  std::vector<double> out = phases;
  std::vector<size_t> fixed;  // Frames whose phase is known.
  for (size_t begin = 0, end = 0; begin <= steps; begin = end) {
    for (end = begin + 1; end <= steps && flies[end] == flies[begin]; ++end) {
    }
    if (flies[begin] && begin == 0 && end > steps) break;
    const double landing = end > steps ? length : std::round(phases[end - 1]);
    for (size_t i = begin; flies[begin] && i < end; ++i) {
      out[i] = begin == 0 ? static_cast<double>(i) : landing - static_cast<double>(end - 1 - i);
      fixed.push_back(i);
    }
  }
  if (fixed.empty() || fixed.front() != 0) fixed.insert(fixed.begin(), 0), out[0] = 0;
  if (fixed.back() != steps) fixed.push_back(steps), out[steps] = length;
  for (size_t f = 1; f < fixed.size(); ++f) {
    const size_t from = fixed[f - 1], to = fixed[f];
    const double stretch = (out[to] - out[from]) / (phases[to] - phases[from]);
    for (size_t i = from + 1; i < to; ++i) {
      out[i] = out[from] + stretch * (phases[i] - phases[from]);
    }
  }
  return out;
}

}  // namespace

std::vector<double> loop_schedule(const std::vector<PaceSample>& last, int length, int frames) {
  const double wanted = duration(last, length);
  if (!(std::abs(wanted - frames) <= kSameFrames)) frames = static_cast<int>(std::lround(wanted));
  frames = std::max(frames, 1);
  std::vector<double> phases = play(last, length, frames, 0);
  float low = -kMaxFit, high = kMaxFit;
  for (int i = 0; i < 30 && phases.back() != length; ++i) {
    const float middle = (low + high) / 2;
    phases = play(last, length, frames, middle);
    (phases.back() < length ? low : high) = middle;
  }
  return fit_between_flights(last, length, phases);
}

}  // namespace panache
