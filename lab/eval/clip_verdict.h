#pragma once
// Whole clips, told among the styles of one performer by a judge that knows this performer alone,
// and what the verdicts on many clips come to.

#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "eval/metrics.h"

namespace panache {

// One clip before one judge.
struct ClipVerdict {
  std::string performer;  // Whose motion it is, or was made from,
  std::string judge;      // and whose judge this is.
  std::string style;      // What was asked for, or what a real take shows: "neutral" is one too.
  std::string content;
  std::string verdict;  // What most windows are taken for.
  // Mean distance of the joints from the nearest real take, see warped_distance().
  double cm = kNotMeasured;
  // Speed and sharpness of the hands (see kTraits), divided by those of the real takes.
  double hand_speed = kNotMeasured, hand_sharpness = kNotMeasured;

  bool recognised() const { return verdict == style; }
};

// Clips of one kind. Without clips, shares and means are NaN.
struct ClipSummary {
  size_t clips = 0;
  double recognised = kNotMeasured;  // Share of the clips.
  double cm = kNotMeasured;          // Means of what was measured; of ratios geometric ones.
  double hand_speed = kNotMeasured, hand_sharpness = kNotMeasured;
};
ClipSummary summarize_clips(const std::vector<ClipVerdict>& clips);

// The clips of each style, performer or content, in order of the alphabet.
using ClipGroups = std::map<std::string, std::vector<ClipVerdict>>;
ClipGroups clips_by(std::string ClipVerdict::*name, const std::vector<ClipVerdict>& clips);

// All but the real neutral takes.
std::vector<ClipVerdict> styled_clips(const std::vector<ClipVerdict>& clips);
// Those of styles that several performers have, where each is judged by the performer's own judge.
std::vector<ClipVerdict> shared_clips(const std::vector<ClipVerdict>& real,
                                      const std::vector<ClipVerdict>& clips);

// How many clips of a style (first) are taken for a style (second).
using Confusion = std::map<std::pair<std::string, std::string>, size_t>;
Confusion confusion(const std::vector<ClipVerdict>& clips);
// All names in the confusions of `clips`, the styles of each performer beside each other, in order
// of the performers.
std::vector<std::string> confusion_labels(const std::vector<ClipVerdict>& clips);

}  // namespace panache
