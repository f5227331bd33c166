#include "eval/report_ood.h"

#include <algorithm>

#include "eval/report_numbers.h"

namespace panache {
namespace {

// Share of the outputs of one clip that are recognised as the requested style, and their number.
// scores: as in OodVerdict.
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
    // Chooses among the requested styles.
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

std::vector<double> values_of(const std::vector<OodRow>& rows, double OodRow::*value) {
  std::vector<double> values;
  values.reserve(rows.size());
  for (const OodRow& row : rows) values.push_back(row.*value);
  return values;
}

std::vector<double> shots_of(const std::vector<OodRow>& rows, size_t measure) {
  std::vector<double> values;
  for (const OodRow& row : rows) {
    values.insert(values.end(), row.shot[measure].begin(), row.shot[measure].end());
  }
  return values;
}

LegSummary summarize_legs(const std::vector<OodRow>& rows) {
  LegRange upright, crouching;
  const auto add = [](const LegRange& of_row, LegRange& sum) {
    sum.legs += of_row.legs;
    sum.thighs += of_row.thighs;
    sum.knees += of_row.knees;
    sum.worst_deg = std::max(sum.worst_deg, of_row.worst_deg);
  };
  for (const OodRow& row : rows) add(row.upright, upright), add(row.crouching, crouching);
  const auto share = [](int count, const LegRange& of) {
    return of.legs > 0 ? static_cast<double>(count) / of.legs : kNotMeasured;
  };
  return {share(upright.thighs, upright), share(upright.knees, upright),
          share(crouching.thighs, crouching), share(crouching.knees, crouching),
          std::max(upright.worst_deg, crouching.worst_deg)};
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
