#pragma once
// How well a remover takes styles off, and tells which style a motion shows.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "eval/metrics.h"
#include "eval/test_input.h"
#include "style/model.h"

namespace panache {

struct TestSet;

// What became of clips that lost their style. Means over the clips.
struct RemovalSummary {
  size_t clips = 0;
  double neutral = kNotMeasured;  // Share that the judge takes for neutral,
  double before = kNotMeasured;   // and of the inputs.
  // Share of windows recognised as the content, relative to that of the input.
  double content = kNotMeasured;
  // Distance from the nearest neutral take, or from what was restyled, cm; relative to the input's.
  double cm = kNotMeasured, cm_ratio = kNotMeasured;
  double jerk = kNotMeasured;   // Relative to the input.
  double jumps = kNotMeasured;  // Frames of all clips where a joint jumps; NaN where time changes.
};
struct RecognitionSummary {
  size_t clips = 0, neutral_clips = 0;
  double first = kNotMeasured, third = kNotMeasured;  // Share with the style first, or in three.
  double neutral = kNotMeasured;                      // Share of neutral clips told as such.
};

struct RemovalReport {
  // Styled test takes, each before its performer's judge: by the head of its style, and by
  // kAnyStyle.
  RemovalSummary named, any;
  // Out-of-distribution clips that a model restyled, at the input's tempo; `original`: the clips
  // themselves, as if they were the output. Before a judge of all styles.
  RemovalSummary restyled, original;
  RecognitionSummary recognition;  // Of test takes; neutral ones of the performers,
  RecognitionSummary others;       // and of out-of-distribution clips.
};

// `model`: what restyles the files of `ood`; null, or no files: they are not measured.
Result<RemovalReport> measure_removal(const std::shared_ptr<const Model>& remover,
                                      const std::shared_ptr<const Model>& model,
                                      const TestSet& test_set, const std::vector<std::string>& ood);

}  // namespace panache
