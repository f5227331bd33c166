#pragma once
// Style recognition of whole clips by a classifier trained on one performer only, and summaries
// over many clips.

#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "eval/metrics.h"

namespace panache {

// The result for one clip and one performer's classifier.
struct ClipVerdict {
  std::string performer;  // Performer of the motion or of its input,
  std::string judge;      // and of the classifier.
  std::string style;      // The requested style, or that of a real take; may be "neutral".
  std::string content;
  std::string verdict;  // The class of most windows.
  // Mean joint distance to the nearest real take, see warped_distance().
  double cm = kNotMeasured;
  // Speed and sharpness of the hands (see kTraits), relative to the real takes.
  double hand_speed = kNotMeasured, hand_sharpness = kNotMeasured;

  bool recognised() const { return verdict == style; }
};

// A summary of clips of one kind. Without clips, shares and means are NaN.
struct ClipSummary {
  size_t clips = 0;
  double recognised = kNotMeasured;  // Share of the clips.
  double cm = kNotMeasured;          // Means of the measured values; geometric for ratios.
  double hand_speed = kNotMeasured, hand_sharpness = kNotMeasured;
};
ClipSummary summarize_clips(const std::vector<ClipVerdict>& clips);

// The clips by style, performer or content, sorted by name.
using ClipGroups = std::map<std::string, std::vector<ClipVerdict>>;
ClipGroups clips_by(std::string ClipVerdict::*name, const std::vector<ClipVerdict>& clips);

// All except the real neutral takes.
std::vector<ClipVerdict> styled_clips(const std::vector<ClipVerdict>& clips);
// Clips of styles that several performers have, each with its own performer's classifier.
std::vector<ClipVerdict> shared_clips(const std::vector<ClipVerdict>& real,
                                      const std::vector<ClipVerdict>& clips);

// Number of clips of a style (first) that are recognised as a style (second).
using Confusion = std::map<std::pair<std::string, std::string>, size_t>;
Confusion confusion(const std::vector<ClipVerdict>& clips);
// All names in the confusions of `clips`, with the styles of each performer next to each other,
// ordered by performer.
std::vector<std::string> confusion_labels(const std::vector<ClipVerdict>& clips);

}  // namespace panache
