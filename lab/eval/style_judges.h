#pragma once
// Style classifiers of different families, for motion without a real counterpart: what fools one
// does not fool the other.

#include <memory>
#include <string>
#include <vector>

#include "eval/discriminant.h"
#include "eval/ood.h"
#include "takes/signature.h"
#include "train/classifier.h"

namespace panache {

class StyleJudges : public OodJudge {
 public:
  // Learns styles and neutral from `takes` (features in layout positions).
  StyleJudges(const std::vector<Take>& takes, const std::vector<Pairing>& pairings, uint64_t seed);

  OodVerdict judge(const Take& input, const Take& output, double log_rate,
                   const std::string& style) const override;
  // The same for a real take: the accuracy of the classifiers. Nothing is compared.
  OodVerdict judge_real(const Take& take) const;
  // The signature of real takes, leaving out one action at a time.
  SignatureMatch real_signature(const std::string& style) const { return signatures_.real(style); }
  const Signature* signature(const std::string& style) const { return signatures_.find(style); }

 private:
  StyleJudges(const std::vector<Take>& takes, const std::vector<Pairing>& pairings, uint64_t seed,
              std::vector<std::string> styles, const std::vector<std::string>& labels);

  // Style recognition of a take, without the signature.
  OodVerdict recognise(const Take& take, const std::string& wanted) const;

  std::vector<std::string> styles_;  // Without neutral, which is the last class of both.
  Classifier robust_;
  Discriminant lda_;
  Signatures signatures_;
};

// Tests such classifiers on real styled takes of actions that they were not trained on, to show how
// reliable they are for unseen actions. Actions are split into four groups, each classified by
// classifiers of the others; actions that begin with the same word (walk, walk-left) are in one
// group. A row is a take; its clip is the n-th take of an action by any performer. Uses at most six
// takes per style and action. Empty if there is only one group.
std::vector<OodRow> judge_unseen_actions(const std::vector<Take>& takes, uint64_t seed);

}  // namespace panache
