#pragma once
// Judges of different families for motion that has no real counterpart: they must not be fooled
// together.

#include <memory>
#include <string>
#include <vector>

#include "eval/discriminant.h"
#include "eval/ood.h"
#include "learn/signature.h"
#include "train/classifier.h"

namespace panache {

class StyleJudges : public OodJudge {
 public:
  // Styles and neutral as `takes` (numbers in layout positions) show them.
  StyleJudges(const std::vector<Take>& takes, const std::vector<Pairing>& pairings, uint64_t seed);

  OodVerdict judge(const Take& input, const Take& output, double log_rate,
                   const std::string& style) const override;
  // The same for a real take: how well the judges know what a style is. Nothing is compared.
  OodVerdict judge_real(const Take& take) const;
  // What real takes agree on, left out one action at a time.
  SignatureMatch real_signature(const std::string& style) const { return signatures_.real(style); }
  const Signature* signature(const std::string& style) const { return signatures_.find(style); }

 private:
  StyleJudges(const std::vector<Take>& takes, const std::vector<Pairing>& pairings, uint64_t seed,
              std::vector<std::string> styles, const std::vector<std::string>& labels);

  // How well a take is recognised as of this style, but for its signature.
  OodVerdict recognise(const Take& take, const std::string& wanted) const;

  std::vector<std::string> styles_;  // Neutral is not among them, but the last class of both.
  Classifier robust_;
  Discriminant lda_;
  Signatures signatures_;
};

// What such judges say of real styled takes of actions that they were not trained on: what their
// verdicts are worth where an action was never captured. The actions are split into four
// groups, of which each is judged by judges of the others; actions whose names begin with the same
// word (walk, walk-left) are in one group. A row is a take; its clip is the n-th take of an action
// by any performer. At most six takes of a style and action are judged. Empty where all actions are
// of one group.
std::vector<OodRow> judge_unseen_actions(const std::vector<Take>& takes, uint64_t seed);

}  // namespace panache
