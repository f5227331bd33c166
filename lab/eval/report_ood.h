#pragma once
// Summarises many clips in many styles.

#include <string>
#include <utility>
#include <vector>

#include "eval/metrics.h"
#include "eval/ood.h"

namespace panache {

// Style recognition of many outputs, see OodVerdict; NaN if there are none.
struct StyleSummary {
  double style_robust = kNotMeasured, style_lda = kNotMeasured;  // Means over outputs.
  // Share of outputs with the highest score for the requested style, among the outputs of one clip
  // in all styles, after subtracting each classifier's bias (mean score) for a style over them.
  double forced_mlp = kNotMeasured, forced_lda = kNotMeasured;
  // Changes that a style's real takes agree on: share with the right sign, and share with half to
  // twice the real amount.
  double signature_sign = kNotMeasured, signature_amount = kNotMeasured;
};
StyleSummary summarize_styles(const std::vector<OodRow>& rows);

// One value of each row; all values of one measure of kShotKeys.
std::vector<double> values_of(const std::vector<OodRow>& rows, double OodRow::*value);
std::vector<double> shots_of(const std::vector<OodRow>& rows, size_t measure);

// The shares of legs beyond their range, and the largest excess in degrees; see LegRange. NaN
// without such legs.
struct LegSummary {
  double upright_thighs, upright_knees, crouching_thighs, crouching_knees, worst_deg;
};
LegSummary summarize_legs(const std::vector<OodRow>& rows);

// The rows of each clip, in order of first occurrence.
std::vector<std::pair<std::string, std::vector<OodRow>>> ood_by_clip(
    const std::vector<OodRow>& rows);

}  // namespace panache
