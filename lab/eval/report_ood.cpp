#include "eval/report_ood.h"

#include <algorithm>

#include "eval/report_numbers.h"

namespace panache {
namespace {

std::vector<double> values_of(const std::vector<OodRow>& rows, double OodRow::*value) {
  std::vector<double> values;
  values.reserve(rows.size());
  for (const OodRow& row : rows) values.push_back(row.*value);
  return values;
}

size_t above_zero(const std::vector<double>& values) {
  return static_cast<size_t>(
      std::count_if(values.begin(), values.end(), [](double v) { return v > 0; }));
}

// Share of the outputs of one clip that are taken for the style that they were asked for, and how
// many there are. scores: of OodVerdict.
void choose(const std::vector<OodRow>& clip, std::vector<double> OodVerdict::*scores, double& right,
            double& outputs) {
  std::vector<const OodVerdict*> verdicts;
  for (const OodRow& row : clip) {
    if (row.verdict.style >= 0) verdicts.push_back(&row.verdict);
  }
  if (verdicts.size() < 2) return;
  std::vector<double> liking((verdicts.front()->*scores).size());
  for (const OodVerdict* verdict : verdicts) {
    for (size_t s = 0; s < liking.size(); ++s) {
      liking[s] += (verdict->*scores)[s] / static_cast<double>(verdicts.size());
    }
  }
  for (const OodVerdict* verdict : verdicts) {
    // The choice is among the styles that were asked for.
    const OodVerdict* best = verdicts.front();
    const auto speaks_for = [&](const OodVerdict* style) {
      return (verdict->*scores)[style->style] - liking[style->style];
    };
    for (const OodVerdict* other : verdicts) {
      if (speaks_for(other) > speaks_for(best)) best = other;
    }
    right += best == verdict;
    ++outputs;
  }
}

}  // namespace

StyleSummary summarize_styles(const std::vector<OodRow>& rows) {
  StyleSummary out;
  std::vector<double> robust, lda;
  SignatureMatch signature;
  for (const OodRow& row : rows) {
    robust.push_back(row.verdict.style_robust);
    lda.push_back(row.verdict.style_lda);
    signature += row.verdict.signature;
  }
  out.style_robust = finite_mean(robust);
  out.style_lda = finite_mean(lda);
  out.signature_sign = signature.sign_share();
  out.signature_amount = signature.amount_share();
  double mlp = 0, mlp_outputs = 0, lda_right = 0, lda_outputs = 0;
  for (const auto& [clip, of_clip] : ood_by_clip(rows)) {
    choose(of_clip, &OodVerdict::robust_scores, mlp, mlp_outputs);
    choose(of_clip, &OodVerdict::lda_scores, lda_right, lda_outputs);
  }
  if (mlp_outputs > 0) out.forced_mlp = mlp / mlp_outputs;
  if (lda_outputs > 0) out.forced_lda = lda_right / lda_outputs;
  return out;
}

ShotSummaries summarize_shots(const std::vector<OodRow>& rows) {
  ShotSummaries out;
  for (size_t i = 0; i < out.size(); ++i) {
    std::vector<double> values;
    for (const OodRow& row : rows) {
      values.insert(values.end(), row.shot[i].begin(), row.shot[i].end());
    }
    if (values.empty()) continue;
    const auto over = std::count_if(values.begin(), values.end(), [](double v) { return v > 2; });
    out[i] = {values.size(), quantile(values, 0.5), quantile(values, 0.9),
              static_cast<double>(over) / static_cast<double>(values.size())};
  }
  return out;
}

std::map<std::string, SignatureMatch> signatures_by_style(const std::vector<OodRow>& rows) {
  std::map<std::string, SignatureMatch> styles;
  for (const OodRow& row : rows) {
    if (row.verdict.signature.takes > 0) styles[row.style] += row.verdict.signature;
  }
  return styles;
}

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
  for (const OodRow& row : rows) {
    out.jumps += static_cast<size_t>(row.jumps);
    out.jump_rows += row.jumps > 0;
  }
  out.skating_ratio_mean = finite_mean(values_of(rows, &OodRow::skating_ratio));
  out.input_skating_ratio_mean = finite_mean(values_of(rows, &OodRow::input_skating_ratio));
  out.turned_deg_mean = finite_mean(values_of(rows, &OodRow::turned_deg));
  out.drift_m_max = quantile(values_of(rows, &OodRow::drift_m), 1);
  out.gate_mean = finite_mean(values_of(rows, &OodRow::gate));
  out.styles = summarize_styles(rows);
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
