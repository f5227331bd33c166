#pragma once
// Many clips in many styles in a few numbers.

#include <string>
#include <utility>
#include <vector>

#include "eval/metrics.h"
#include "eval/ood.h"

namespace panache {

// What the judges of the styles say of many outputs, see OodVerdict; NaN where there is nothing.
struct StyleSummary {
  double style_robust = kNotMeasured, style_lda = kNotMeasured;  // Means over outputs.
  // Share of the outputs that speak more for the style asked for than for any other, when one clip
  // is put out in all styles and each judge's liking for a style, as the mean over those outputs
  // shows it, is taken off.
  double forced_mlp = kNotMeasured, forced_lda = kNotMeasured;
  // Of the changes that a style's real takes agree on: share with the right sign, share by half to
  // double of the real change.
  double signature_sign = kNotMeasured, signature_amount = kNotMeasured;
};
StyleSummary summarize_styles(const std::vector<OodRow>& rows);

// The rows of each clip, in order of their first one.
std::vector<std::pair<std::string, std::vector<OodRow>>> ood_by_clip(
    const std::vector<OodRow>& rows);

}  // namespace panache
