#pragma once
// Compares motion that a system put out with real held-out takes.

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "eval/aligned_takes.h"
#include "train/classifier.h"
#include "eval/measure.h"
#include "eval/system.h"
#include "learn/take.h"

namespace panache {

// Per style and content.
using StyleContent = std::pair<std::string, std::string>;
using StyleContentTable = std::map<StyleContent, Metrics>;

// Means of a table per content or style.
MetricsTable by_content(const StyleContentTable& cells);
MetricsTable by_style(const StyleContentTable& cells);
// Below these shares of real held-out windows, what the classifiers say of other motion means
// little by itself: the report says so, and that it is to be compared with real motion.
struct AccuracyFloor {
  double style = 0.95, content = 0.90;
};

class Evaluator {
 public:
  // `training`: takes the classifiers learn from; `test`: real takes they do not; numbers in layout
  // positions. Styles and contents to tell apart are those of `test`, "neutral" included.
  static Evaluator create(const std::vector<Take>& training, std::vector<Take> test, uint64_t seed);

  // Real styled test takes, judged like outputs.
  const StyleContentTable& real() const { return real_; }
  // Judges outputs whose style and content have a real take in `test`; others are left out.
  // `inputs`: the neutral takes that outputs refer to. `aligned`: the pose errors of the system.
  StyleContentTable evaluate(const std::vector<StyledTake>& outputs,
                             const std::vector<Take>& inputs, const PoseErrors& aligned = {}) const;

  const Classifier& styles() const { return styles_; }
  const Classifier& contents() const { return contents_; }
  // The styled test takes.
  const std::vector<Take>& test() const { return test_; }

 private:
  // One take, judged by itself.
  struct TakeScores {
    size_t windows = 0;
    std::vector<double> values;  // Of each measure's of_take().
    torch::Tensor features;
  };
  // Those of one style and content.
  using Verdicts = std::vector<TakeScores>;

  Evaluator(Classifier styles, Classifier contents, std::vector<Take> test);
  // `of` names the take, and what it was made from.
  TakeScores look(TakeEvidence of) const;
  // What the measures say of them beside the real takes of the same style and content.
  static Metrics summarise(const Verdicts& all_scores, const Verdicts& real,
                           const std::optional<PoseError>& aligned);

  Classifier styles_, contents_;
  std::vector<Take> test_;
  std::map<StyleContent, Verdicts> references_;  // Of test_.
  StyleContentTable real_;
};

}  // namespace panache
