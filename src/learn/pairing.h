#pragma once
// Which neutral instant each styled instant corresponds to. Styled and neutral takes are not
// recorded in step: each window of a styled take is aligned with the neutral takes of the same
// action by subsequence dynamic time warping, with free start and end on the neutral side.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "learn/take.h"

namespace panache {

// One window of a styled take and its alignment with a neutral one.
struct Pairing {
  int styled = 0, neutral = 0;        // Indices of takes.
  int first = 0;                      // First frame of the window in the styled take.
  std::vector<float> neutral_frames;  // Per frame of the window; smoothed, fractional.
  std::vector<float> rates;           // Neutral seconds per styled second.
  float cost = 0;                     // Mean over frames of the squared distance, in deviations.
  std::string style = {};             // The style that it teaches; empty: that of the styled take.
};

// Takes of one action that match well cost less than this; most cost a third of it.
inline constexpr float kGoodMatch = 0.35f;

struct PairingOptions {
  double window_seconds = 1.5;
  double hop_seconds = 0.5;
};
// For neutral takes with less of a cycle than a window of a styled take: in a run of 1 s, 1.5 s of
// a styled run are nowhere in step, but any third of a cycle is.
inline constexpr PairingOptions kShortWindows = {.window_seconds = 0.45, .hop_seconds = 0.15};

// Pairs the styled takes among `styled` with the neutral takes among `neutral` (indices into
// `takes`) of the same set and content. A performer without neutral takes of a content gets those
// of all other performers of the manifest. Contents without a neutral take are skipped. A take that
// matches badly, but much better in short windows, is paired in these. Uses all cores; `progress`
// gets the fraction done.
std::vector<Pairing> pair_takes(const std::vector<Take>& takes, const std::vector<int>& styled,
                                const std::vector<int>& neutral, const PairingOptions& options = {},
                                const std::function<void(double)>& progress = {});

// Whether the same foot is in front in matched frames, weighted by the distance: 1 always, -1 never
// (left was paired with right), nothing if the feet stay next to each other.
std::optional<double> step_agreement(const std::vector<Take>& takes,
                                     const std::vector<Pairing>& pairings);

// Clips of one cycle, as in motion libraries: a stride that ends in the pose it starts with. Two of
// them may start anywhere in the cycle, so a neutral one is continued until the other fits.

// The number of frames (at kTakeRate) of one cycle, if the clip is one: its first pose repeats at
// its end, or would a frame later, wherever the body has moved meanwhile. 0 if it is not, or is
// longer than 2 seconds.
int cycle_frames(const Clip& clip, const Rig& rig);

// Pairs takes[styled] with takes[neutral], see pair_takes(). If the neutral take is one cycle (of
// `cycle` frames; 0 if not) and matches better when continued, it is replaced by several cycles,
// each starting where the one before ended.
std::vector<Pairing> pair_in_phase(std::vector<Take>& takes, int styled, int neutral, int cycle);

// Mean of Pairing::cost; very large without pairings.
double mean_cost(const std::vector<Pairing>& pairings);

}  // namespace panache
