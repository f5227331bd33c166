#pragma once
// A classifier for each performer, which distinguishes that performer's styles and neutral motion
// only. A common classifier for all would recognise persons as much as styles.

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
  // Makes a classifier for each set (performer) of `training` with at least two labels, styles or
  // neutral. `test`: their real held-out takes, neutral and styled.
  PerformerJudges(const std::vector<Take>& training, const std::vector<Take>& test);

  // Classifies the real held-out takes with their own performer's classifier: an upper bound.
  // Compared with the training takes of the same style, performer and content.
  const std::vector<ClipVerdict>& real() const { return real_; }
  // Classifies outputs made from a performer's motion (row.set) with this performer's classifier,
  // if it knows the style. Compared with the real held-out takes of the same style, performer and
  // content.
  std::vector<ClipVerdict> judge(const std::vector<Take>& outputs) const;

  // Classifies clips, real or generated, with all other performers who show the same style in the
  // same content. Subtracts the mean difference between the two performers' neutral takes of this
  // content first, if both have any. No distances are measured.
  std::vector<ClipVerdict> judge_across(const std::vector<Take>& clips) const;
  // Whether judge_across() applies to such a clip.
  bool is_judged_across(const ManifestRow& row) const;

 private:
  struct Judge {
    std::string performer;
    std::vector<std::string> labels;
    Discriminant discriminant;
    std::map<std::string, torch::Tensor> neutral;  // Mean statistics of neutral takes by content.
  };
  using Cell = std::tuple<int, std::string, std::string>;  // Set, style, content.
  using Cells = std::map<Cell, std::vector<Take>>;

  ClipVerdict verdict(const Judge& judge, const Take& clip, const torch::Tensor& shift) const;
  std::vector<ClipVerdict> verdicts(const std::vector<Take>& clips, const Cells& references) const;

  std::map<int, Judge> judges_;  // By set.
  Cells training_, test_;
  std::vector<ClipVerdict> real_;
};

inline constexpr int kWarpedFrames = 60;  // Of a window; windows start every half second.

// Aligns windows of `take` with the best match in `real`, with free start and end, at half to
// double speed; a window has two seconds, or the length of the shorter motion. Returns the mean
// joint distance in the body frame over windows and frames, cm.
double warped_distance(const Take& take, const Take& real);

}  // namespace panache
