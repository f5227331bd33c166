#pragma once
// Which neutral instant each styled instant corresponds to. Styled and neutral takes are not
// recorded in step: each window of a styled take is laid over the neutral takes of the same action
// by subsequence dynamic time warping, start and end free on the neutral side.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "learn/take.h"

namespace panache {

// One window of a styled take and where it lies on a neutral one.
struct Pairing {
  int styled = 0, neutral = 0;        // Indices of takes.
  int first = 0;                      // First frame of the window in the styled take.
  std::vector<float> neutral_frames;  // Per frame of the window; smoothed, fractional.
  std::vector<float> rates;           // Neutral seconds per styled second.
  float cost = 0;                     // Mean over frames of the squared distance, in deviations.
  std::string style = {};             // What it teaches; empty: the style of the styled take.
};

// The cost of takes of one action that go together well is below this; most are at a third of it.
inline constexpr float kGoodMatch = 0.35f;

struct PairingOptions {
  double window_seconds = 1.5;
  double hop_seconds = 0.5;
};
// Where the neutral takes hold less of a cycle than a window of a styled take: in a run of 1 s, 1.5
// s of a styled run find no place that is in step, but any third of a cycle does.
inline constexpr PairingOptions kShortWindows = {.window_seconds = 0.45, .hop_seconds = 0.15};

// Pairs the styled takes among `styled` with the neutral takes among `neutral` (indices into
// `takes`) of the same set and content; those of a performer who has none of a content, with the
// neutral takes of all other performers of the manifest. Contents without a neutral take are left
// out. A take that matches badly and much better in short windows is paired in these. Over all
// cores; `progress` gets the share done.
std::vector<Pairing> pair_takes(const std::vector<Take>& takes, const std::vector<int>& styled,
                                const std::vector<int>& neutral, const PairingOptions& options = {},
                                const std::function<void(double)>& progress = {});

// Whether the same foot is in front in what was laid together, weighted by how far: 1 always, -1
// never (left was paired with right), nothing where the feet stay beside each other.
std::optional<double> step_agreement(const std::vector<Take>& takes,
                                     const std::vector<Pairing>& pairings);

}  // namespace panache
