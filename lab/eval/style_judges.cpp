#include "eval/style_judges.h"

#include <algorithm>
#include <filesystem>
#include <functional>
#include <map>
#include <set>

namespace panache {
namespace {

constexpr ClassifierSettings kRobust = {
    .hidden = 96, .networks = 2, .steps = 2500, .disturbed = true};
constexpr int kGroups = 4;       // Of actions, left out in turn.
constexpr int kJudgedTakes = 6;  // Per style and action.

// Unlabels takes of actions that were captured only as neutral: a classifier would learn that kicks
// are neutral, and it has to recognise styles in such actions.
std::vector<std::string> labels_of(const std::vector<Take>& takes) {
  std::set<std::pair<int, std::string>> styled;  // Set, content.
  for (const Take& take : takes) {
    if (!take.row.neutral) styled.emplace(take.row.set, take.row.content);
  }
  std::vector<std::string> labels;
  labels.reserve(takes.size());
  for (const Take& take : takes) {
    const bool known = styled.contains({take.row.set, take.row.content});
    labels.push_back(known ? take.row.style : "");
  }
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

std::vector<OodRow> judge_unseen_actions(const std::vector<Take>& takes, uint64_t seed) {
  const auto kind_of = [](const Take& take) {
    return take.row.content.substr(0, take.row.content.find('-'));
  };
  std::map<std::string, int> group;  // By first word of the action.
  for (const Take& take : takes) {
    if (!take.row.neutral) group[kind_of(take)] = 0;
  }
  const int groups = std::min(kGroups, static_cast<int>(group.size()));
  std::vector<OodRow> rows;
  if (groups < 2) return rows;
  int next = 0;
  for (auto& [kind, number] : group) number = next++ % groups;
  for (int left_out = 0; left_out < groups; ++left_out) {
    const auto is_left_out = [&](const Take& take) {
      const auto found = group.find(kind_of(take));
      return found != group.end() && found->second == left_out;
    };
    std::vector<Take> others;
    std::copy_if(takes.begin(), takes.end(), std::back_inserter(others), std::not_fn(is_left_out));
    const StyleJudges judges(others, {}, seed);
    std::map<std::string, int> count;  // By style and action.
    for (const Take& take : takes) {
      if (take.row.neutral || !is_left_out(take)) continue;
      const std::string folder = std::filesystem::path(take.row.path).parent_path().string();
      const std::string action = folder + "/" + take.row.content;
      const int number = count[action + "/" + take.row.style]++;
      if (number >= kJudgedTakes) continue;
      OodRow& row = rows.emplace_back();
      row.clip = action + "/" + std::to_string(number);
      row.style = take.row.style;
      row.verdict = judges.judge_real(take);
    }
  }
  return rows;
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
  // Limits the weight of a single window.
  constexpr double kMinProbability = 1e-4;
  verdict.robust_scores = means_of((probabilities + kMinProbability).log(), styles_.size());
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
