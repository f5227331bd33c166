#pragma once
// Many clips in many styles in a few numbers.

#include <array>
#include <cstddef>
#include <map>
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

// Of a measure of shots, over the frames of all rows where it applies.
struct ShotSummary {
  size_t frames = 0;
  double median = kNotMeasured, p90 = kNotMeasured;
  double over_2 = kNotMeasured;  // Share of the values above 2.
};
using ShotSummaries = std::array<ShotSummary, kShotKeys.size()>;
ShotSummaries summarize_shots(const std::vector<OodRow>& rows);

// Over the rows of one system; NaN where there are none. See OodRow for units.
struct OodSummary {
  size_t rows = 0, clips = 0;
  double jerk_ratio_median = kNotMeasured, jerk_ratio_p90 = kNotMeasured;
  double jerk_ratio_max = kNotMeasured;
  double velocity_correlation_median = kNotMeasured, velocity_correlation_p10 = kNotMeasured;
  double distance_cm_mean = kNotMeasured;
  double beyond_limits_mean = kNotMeasured, beyond_limits_max = kNotMeasured;  // Shares of frames.
  double under_floor_mean = kNotMeasured, under_floor_max = kNotMeasured;
  size_t jumps = 0;  // Frames of all rows together.
  // How many rows have any such frame.
  size_t beyond_limits_rows = 0, under_floor_rows = 0, jump_rows = 0;
  double skating_ratio_mean = kNotMeasured, input_skating_ratio_mean = kNotMeasured;
  double turned_deg_mean = kNotMeasured;
  double drift_m_max = kNotMeasured;
  double gate_mean = kNotMeasured;
  StyleSummary styles;
};

OodSummary summarize_ood(const std::vector<OodRow>& rows);

// What became of the traits in each style, styles in order of the alphabet.
std::map<std::string, SignatureMatch> signatures_by_style(const std::vector<OodRow>& rows);

// The rows of each clip, in order of their first one.
std::vector<std::pair<std::string, std::vector<OodRow>>> ood_by_clip(
    const std::vector<OodRow>& rows);

}  // namespace panache
