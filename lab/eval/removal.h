#pragma once
// Evaluates how well a remover removes styles and recognises them.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "eval/metrics.h"
#include "eval/test_input.h"
#include "style/model/model.h"

namespace panache {

struct TestSet;

// Means over clips whose style was removed.
struct RemovalSummary {
  size_t clips = 0;
  double neutral = kNotMeasured;  // Share recognised as neutral,
  double before = kNotMeasured;   // and likewise of the inputs.
  // Share of windows with the content recognised, relative to the input.
  double content = kNotMeasured;
  // Distance from the nearest neutral take or the original clip, cm; and relative to the input.
  double cm = kNotMeasured, cm_ratio = kNotMeasured;
  double jerk = kNotMeasured;   // Relative to the input.
  double jumps = kNotMeasured;  // Frames of all clips where a joint jumps; NaN if time changes.
};
struct RecognitionSummary {
  size_t clips = 0, neutral_clips = 0;
  double first = kNotMeasured, third = kNotMeasured;  // Share with the style first, or in three.
  double neutral = kNotMeasured;                      // Share of neutral clips found neutral.
};

struct RemovalReport {
  // Styled test takes, classified by their performer's classifier: with the style's head, and with
  // kAnyStyle.
  RemovalSummary named, any;
  // Out-of-distribution clips restyled by a model at the input's tempo; `original`: the clips
  // themselves as outputs. Classified among all styles.
  RemovalSummary restyled, original;
  RecognitionSummary recognition;  // Test takes, with the performers' neutral ones,
  RecognitionSummary others;       // and out-of-distribution clips.
};

// `model`: restyles the files of `ood`; without it or files, they are not evaluated.
Result<RemovalReport> measure_removal(const std::shared_ptr<const Model>& remover,
                                      const std::shared_ptr<const Model>& model,
                                      const TestSet& test_set, const std::vector<std::string>& ood);

}  // namespace panache
