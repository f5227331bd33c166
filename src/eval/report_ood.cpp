#include "eval/report_ood.h"

#include <algorithm>

#include "eval/report_numbers.h"

namespace panache {
namespace {

std::vector<double> values_of(const std::vector<OodRow>& rows, double OodRow::*value) {
  std::vector<double> values;
  for (const OodRow& row : rows) values.push_back(row.*value);
  return values;
}

size_t above_zero(const std::vector<double>& values) {
  return static_cast<size_t>(
      std::count_if(values.begin(), values.end(), [](double v) { return v > 0; }));
}

}  // namespace

OodSummary summarize_ood(const std::vector<OodRow>& rows) {
  OodSummary out;
  out.rows = rows.size();
  out.clips = ood_by_clip(rows).size();
  const auto jerk = values_of(rows, &OodRow::jerk_ratio);
  out.jerk_ratio_median = quantile(jerk, 0.5);
  out.jerk_ratio_p90 = quantile(jerk, 0.9);
  out.jerk_ratio_max = quantile(jerk, 1);
  const auto correlation = values_of(rows, &OodRow::velocity_correlation);
  out.velocity_correlation_median = quantile(correlation, 0.5);
  out.velocity_correlation_p10 = quantile(correlation, 0.1);
  out.distance_cm_mean = finite_mean(values_of(rows, &OodRow::distance_cm));
  const auto beyond = values_of(rows, &OodRow::beyond_limits);
  out.beyond_limits_mean = finite_mean(beyond);
  out.beyond_limits_max = quantile(beyond, 1);
  out.beyond_limits_rows = above_zero(beyond);
  const auto under = values_of(rows, &OodRow::under_floor);
  out.under_floor_mean = finite_mean(under);
  out.under_floor_max = quantile(under, 1);
  out.under_floor_rows = above_zero(under);
  out.skating_ratio_mean = finite_mean(values_of(rows, &OodRow::skating_ratio));
  out.input_skating_ratio_mean = finite_mean(values_of(rows, &OodRow::input_skating_ratio));
  out.drift_m_max = quantile(values_of(rows, &OodRow::drift_m), 1);
  out.gate_mean = finite_mean(values_of(rows, &OodRow::gate));
  return out;
}

std::vector<std::pair<std::string, std::vector<OodRow>>> ood_by_clip(
    const std::vector<OodRow>& rows) {
  std::vector<std::pair<std::string, std::vector<OodRow>>> clips;
  for (const OodRow& row : rows) {
    auto clip = std::find_if(clips.begin(), clips.end(),
                             [&](const auto& known) { return known.first == row.clip; });
    if (clip == clips.end()) clip = clips.insert(clips.end(), {row.clip, {}});
    clip->second.push_back(row);
  }
  return clips;
}

}  // namespace panache
