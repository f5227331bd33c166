#include "eval/clip_verdict.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>

#include "eval/report_numbers.h"

namespace panache {

ClipSummary summarize_clips(const std::vector<ClipVerdict>& clips) {
  std::vector<double> recognised, cm, speed, sharpness;
  for (const ClipVerdict& clip : clips) {
    recognised.push_back(clip.recognised() ? 1 : 0);
    cm.push_back(clip.cm);
    speed.push_back(std::log(clip.hand_speed));
    sharpness.push_back(std::log(clip.hand_sharpness));
  }
  return {clips.size(), finite_mean(recognised), finite_mean(cm), std::exp(finite_mean(speed)),
          std::exp(finite_mean(sharpness))};
}

ClipGroups clips_by(std::string ClipVerdict::*name, const std::vector<ClipVerdict>& clips) {
  ClipGroups groups;
  for (const ClipVerdict& clip : clips) groups[clip.*name].push_back(clip);
  return groups;
}

std::vector<ClipVerdict> styled_clips(const std::vector<ClipVerdict>& clips) {
  std::vector<ClipVerdict> styled;
  std::copy_if(clips.begin(), clips.end(), std::back_inserter(styled),
               [](const ClipVerdict& clip) { return clip.style != "neutral"; });
  return styled;
}

std::vector<ClipVerdict> shared_clips(const std::vector<ClipVerdict>& real,
                                      const std::vector<ClipVerdict>& clips) {
  std::map<std::string, std::set<std::string>> performers;
  for (const ClipVerdict& clip : real) performers[clip.style].insert(clip.performer);
  std::vector<ClipVerdict> shared;
  std::copy_if(clips.begin(), clips.end(), std::back_inserter(shared),
               [&](const ClipVerdict& clip) { return performers[clip.style].size() > 1; });
  return styled_clips(shared);
}

Confusion confusion(const std::vector<ClipVerdict>& clips) {
  Confusion counts;
  for (const ClipVerdict& clip : clips) ++counts[{clip.style, clip.verdict}];
  return counts;
}

std::vector<std::string> confusion_labels(const std::vector<ClipVerdict>& clips) {
  std::vector<std::string> labels;
  const auto add = [&](const std::string& label) {
    if (std::find(labels.begin(), labels.end(), label) == labels.end()) labels.push_back(label);
  };
  for (const auto& [performer, own] : clips_by(&ClipVerdict::performer, clips)) {
    for (const auto& [style, of_style] : clips_by(&ClipVerdict::style, own)) add(style);
  }
  for (const ClipVerdict& clip : clips) add(clip.verdict);
  return labels;
}

}  // namespace panache
