#pragma once
// A judge for each performer: it tells that performer's styles and neutral motion apart, and knows
// nobody else. One judge of all performers would tell persons as much as styles.

#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "eval/clip_verdict.h"
#include "eval/discriminant.h"
#include "learn/take.h"

namespace panache {

class PerformerJudges {
 public:
  // A judge for each set of `training` that shows two labels at least, a style's or neutral's; sets
  // are performers. `test`: real held-out takes of them, neutral and styled.
  PerformerJudges(const std::vector<Take>& training, const std::vector<Take>& test);

  // The real held-out takes themselves, each before its own performer's judge: as much as can be
  // recognised. They are compared with the training takes of their style, performer and content.
  const std::vector<ClipVerdict>& real() const { return real_; }
  // Outputs made from a performer's motion (row.set), each before this performer's judge, where it
  // knows the style. They are compared with the real held-out takes of their style, performer and
  // content.
  std::vector<ClipVerdict> judge(const std::vector<Take>& outputs) const;

  // Clips, real or put out, before the judges of all other performers who show their style in their
  // content. The mean difference between the neutral takes of the two performers in this content is
  // taken off before; nothing is where one of them has none. Compared with nothing.
  std::vector<ClipVerdict> judge_across(const std::vector<Take>& clips) const;
  // Whether judge_across() has anything to say of such a clip.
  bool is_judged_across(const ManifestRow& row) const;

 private:
  struct Judge {
    std::string performer;
    std::vector<std::string> labels;
    Discriminant discriminant;
    std::map<std::string, torch::Tensor> neutral;  // Mean statistics of its takes of a content.
  };
  using Cell = std::tuple<int, std::string, std::string>;  // Set, style, content.
  using Cells = std::map<Cell, std::vector<Take>>;

  ClipVerdict verdict(const Judge& judge, const Take& clip, const torch::Tensor& shift) const;
  std::vector<ClipVerdict> verdicts(const std::vector<Take>& clips, const Cells& references) const;

  std::map<int, Judge> judges_;  // By set.
  Cells training_, test_;
  std::vector<ClipVerdict> real_;
};

}  // namespace panache
