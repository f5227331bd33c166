#pragma once
// Which neutral instant each styled instant corresponds to. Styled and neutral takes are not
// recorded in step: each window of a styled take is laid over the neutral takes of the same action
// by subsequence dynamic time warping, start and end free on the neutral side.

#include <functional>
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
};

struct PairingOptions {
  double window_seconds = 1.5;
  double hop_seconds = 0.5;
};

// Pairs the styled takes among `styled` with the neutral takes among `neutral` (indices into
// `takes`) of the same set and content. Contents without a neutral take are left out. Over all
// cores; `progress` gets the share done.
std::vector<Pairing> pair_takes(const std::vector<Take>& takes, const std::vector<int>& styled,
                                const std::vector<int>& neutral, const PairingOptions& options = {},
                                const std::function<void(double)>& progress = {});

}  // namespace panache
