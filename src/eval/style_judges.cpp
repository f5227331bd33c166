#include "eval/style_judges.h"

#include <algorithm>
#include <set>

namespace panache {
namespace {

constexpr ClassifierSettings kRobust = {
    .hidden = 96, .networks = 2, .steps = 2500, .disturbed = true};

std::vector<std::string> labels_of(const std::vector<Take>& takes) {
  std::vector<std::string> labels;
  for (const Take& take : takes) labels.push_back(take.row.style);
  return labels;
}

std::vector<std::string> styles_of(const std::vector<Take>& takes) {
  std::set<std::string> styles;
  for (const Take& take : takes) {
    if (!take.row.neutral) styles.insert(take.row.style);
  }
  return {styles.begin(), styles.end()};
}

std::vector<std::string> and_neutral(std::vector<std::string> styles) {
  styles.push_back("neutral");
  return styles;
}

double share_of(const torch::Tensor& scores, int wanted) {
  return scores.argmax(1).eq(wanted).to(torch::kFloat64).mean().item<double>();
}

std::vector<double> means_of(const torch::Tensor& scores, size_t styles) {
  const torch::Tensor mean = scores.to(torch::kFloat64).mean(0).contiguous();
  return {mean.data_ptr<double>(), mean.data_ptr<double>() + styles};
}

}  // namespace

StyleJudges::StyleJudges(const std::vector<Take>& takes, const std::vector<Pairing>& pairings,
                         uint64_t seed)
    : StyleJudges(takes, pairings, seed, styles_of(takes), labels_of(takes)) {}

StyleJudges::StyleJudges(const std::vector<Take>& takes, const std::vector<Pairing>& pairings,
                         uint64_t seed, std::vector<std::string> styles,
                         const std::vector<std::string>& labels)
    : styles_(std::move(styles)),
      robust_(takes, labels, and_neutral(styles_), seed, kRobust),
      lda_(takes, labels, and_neutral(styles_)),
      signatures_(takes, pairings) {}

OodVerdict StyleJudges::judge_real(const Take& take) const {
  return recognise(take, take.row.style);
}

OodVerdict StyleJudges::recognise(const Take& take, const std::string& wanted) const {
  OodVerdict verdict;
  const auto style = std::find(styles_.begin(), styles_.end(), wanted);
  if (style == styles_.end()) return verdict;
  verdict.style = static_cast<int>(style - styles_.begin());
  const torch::Tensor probabilities = robust_.classify(take).probabilities;
  const torch::Tensor scores = lda_.scores(take);
  verdict.style_robust = share_of(probabilities, verdict.style);
  verdict.style_lda = share_of(scores, verdict.style);
  // No window alone may decide.
  constexpr double kLeastProbability = 1e-4;
  verdict.robust_scores = means_of((probabilities + kLeastProbability).log(), styles_.size());
  verdict.lda_scores = means_of(scores, styles_.size());
  return verdict;
}

OodVerdict StyleJudges::judge(const Take& input, const Take& output, double log_rate,
                              const std::string& style) const {
  OodVerdict verdict = recognise(output, style);
  const Signature* signature = signatures_.find(style);
  if (!signature) return verdict;
  const Traits before = traits(input), after = traits(output);
  Traits change;
  for (size_t t = 0; t < change.size(); ++t) change[t] = after[t] - before[t];
  change[kTempoTrait] = 100 * log_rate;
  verdict.signature.add(*signature, change);
  return verdict;
}

}  // namespace panache
