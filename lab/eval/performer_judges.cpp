#include "eval/performer_judges.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <optional>
#include <set>

#include "base/parallel.h"
#include "takes/signature.h"

namespace panache {
namespace {

constexpr int kWindowFrames = 60;
constexpr size_t kHandSpeed = trait_index("speed"), kHandSharpness = trait_index("sharpness");

// The performer's name in the manifest, or else the manifest's.
std::string name_of(const ManifestRow& row) {
  return row.person.empty() ? std::filesystem::path(row.manifest).stem().string() : row.person;
}

// The class of most windows; ties are decided by the mean probability.
int vote(const torch::Tensor& scores) {
  const torch::Tensor votes =
      torch::one_hot(scores.argmax(1), scores.size(1)).to(torch::kFloat64).sum(0);
  const torch::Tensor mean = torch::softmax(scores, 1).mean(0);  // At most one vote.
  return static_cast<int>((votes + 0.5 * mean).argmax().item<int64_t>());
}

// Distance from the nearest of `real`, and the hands relative to their mean.
void compare(const Take& clip, const std::vector<Take>& real, ClipVerdict& verdict) {
  const Traits own = traits(clip);
  double speed = 0, sharpness = 0;
  verdict.cm = std::numeric_limits<double>::infinity();
  for (const Take& take : real) {
    verdict.cm = std::min(verdict.cm, warped_distance(clip, take));
    const Traits theirs = traits(take);
    speed += (own[kHandSpeed] - theirs[kHandSpeed]) / static_cast<double>(real.size());
    sharpness += (own[kHandSharpness] - theirs[kHandSharpness]) / static_cast<double>(real.size());
  }
  // Traits are 100 times the logarithm.
  verdict.hand_speed = std::exp(speed / 100);
  verdict.hand_sharpness = std::exp(sharpness / 100);
}

}  // namespace

PerformerJudges::PerformerJudges(const std::vector<Take>& training, const std::vector<Take>& test) {
  std::map<int, std::vector<Take>> sets;
  for (const Take& take : training) {
    sets[take.row.set].push_back(take);
    training_[{take.row.set, take.row.style, take.row.content}].push_back(take);
  }
  for (const Take& take : test) {
    test_[{take.row.set, take.row.style, take.row.content}].push_back(take);
  }
  for (const auto& [set, takes] : sets) {
    std::vector<std::string> of_takes;
    for (const Take& take : takes) of_takes.push_back(take.row.style);
    const std::set<std::string> labels(of_takes.begin(), of_takes.end());
    if (labels.size() < 2) continue;
    const std::vector<std::string> classes(labels.begin(), labels.end());
    Judge& judge = judges_
                       .emplace(set, Judge{name_of(takes.front().row),
                                           classes,
                                           Discriminant(takes, of_takes, classes, kWindowFrames),
                                           {}})
                       .first->second;
    std::map<std::string, std::vector<torch::Tensor>> neutral;
    for (const Take& take : takes) {
      if (take.row.neutral) {
        neutral[take.row.content].push_back(judge.discriminant.mean_statistics(take));
      }
    }
    for (const auto& [content, means] : neutral) {
      judge.neutral[content] = torch::stack(means).mean(0);
    }
  }
  real_ = verdicts(test, training_);
}

ClipVerdict PerformerJudges::verdict(const Judge& judge, const Take& clip,
                                     const torch::Tensor& shift) const {
  ClipVerdict verdict;
  verdict.performer = name_of(clip.row);
  verdict.judge = judge.performer;
  verdict.style = clip.row.style;
  verdict.content = clip.row.content;
  verdict.verdict = judge.labels[vote(judge.discriminant.scores(clip, shift))];
  return verdict;
}

std::vector<ClipVerdict> PerformerJudges::verdicts(const std::vector<Take>& clips,
                                                   const Cells& references) const {
  std::vector<std::optional<ClipVerdict>> found(clips.size());
  parallel_for(static_cast<int>(clips.size()), [&](int i) {
    const ManifestRow& row = clips[i].row;
    const auto judge = judges_.find(row.set);
    if (judge == judges_.end()) return;
    const std::vector<std::string>& labels = judge->second.labels;
    if (!std::binary_search(labels.begin(), labels.end(), row.style)) return;
    found[i] = verdict(judge->second, clips[i], {});
    const auto real = references.find({row.set, row.style, row.content});
    if (real != references.end()) compare(clips[i], real->second, *found[i]);
  });
  std::vector<ClipVerdict> all;
  for (std::optional<ClipVerdict>& one : found) {
    if (one) all.push_back(*std::move(one));
  }
  return all;
}

std::vector<ClipVerdict> PerformerJudges::judge(const std::vector<Take>& outputs) const {
  return verdicts(outputs, test_);
}

bool PerformerJudges::is_judged_across(const ManifestRow& row) const {
  return std::any_of(judges_.begin(), judges_.end(), [&](const auto& judge) {
    return judge.first != row.set && training_.contains({judge.first, row.style, row.content});
  });
}

std::vector<ClipVerdict> PerformerJudges::judge_across(const std::vector<Take>& clips) const {
  std::vector<std::vector<ClipVerdict>> found(clips.size());
  parallel_for(static_cast<int>(clips.size()), [&](int i) {
    const ManifestRow& row = clips[i].row;
    const auto own = judges_.find(row.set);
    for (const auto& [set, judge] : judges_) {
      if (set == row.set || !training_.contains({set, row.style, row.content})) continue;
      torch::Tensor shift;
      const auto theirs = judge.neutral.find(row.content);
      if (own != judges_.end() && theirs != judge.neutral.end()) {
        const auto here = own->second.neutral.find(row.content);
        if (here != own->second.neutral.end()) shift = theirs->second - here->second;
      }
      found[i].push_back(verdict(judge, clips[i], shift));
    }
  });
  std::vector<ClipVerdict> all;
  for (const auto& part : found) all.insert(all.end(), part.begin(), part.end());
  return all;
}

}  // namespace panache
