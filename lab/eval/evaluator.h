#pragma once
// Compares the output of systems with real held-out takes.

#include <map>
#include <optional>
#include <string>
#include <torch/types.h>
#include <utility>
#include <vector>

#include "eval/aligned_takes.h"
#include "eval/measure.h"
#include "eval/system.h"
#include "learn/take.h"
#include "train/classifier.h"

namespace panache {

// Per style and content.
using StyleContent = std::pair<std::string, std::string>;
using StyleContentTable = std::map<StyleContent, Metrics>;

// Means of a table per content or per style.
MetricsTable by_content(const StyleContentTable& cells);
MetricsTable by_style(const StyleContentTable& cells);
// Accuracies on real held-out windows below which the classifiers are unreliable on other motion:
// the report then says to compare with real motion.
struct AccuracyFloor {
  double style = 0.95, content = 0.90;
};

class Evaluator {
 public:
  // `training`: takes to train the classifiers on; `test`: real held-out takes; features in layout
  // positions. The classes are the styles and contents of `test`, including "neutral".
  static Evaluator create(const std::vector<Take>& training, std::vector<Take> test, uint64_t seed);

  // Evaluates the real styled test takes like outputs.
  const StyleContentTable& real() const { return real_; }
  // Evaluates outputs whose style and content have a real take in `test`; skips others. `inputs`:
  // the neutral takes that outputs refer to. `aligned`: the pose errors of the system.
  StyleContentTable evaluate(const std::vector<StyledTake>& outputs,
                             const std::vector<Take>& inputs, const PoseErrors& aligned = {}) const;

  const Classifier& styles() const { return styles_; }
  const Classifier& contents() const { return contents_; }
  // The styled test takes.
  const std::vector<Take>& test() const { return test_; }

 private:
  // One take, evaluated by itself.
  struct TakeScores {
    size_t windows = 0;
    std::vector<double> values;  // Results of each measure's of_take().
    torch::Tensor features;
  };
  // Takes of one style and content.
  using Verdicts = std::vector<TakeScores>;

  Evaluator(Classifier styles, Classifier contents, std::vector<Take> test);
  // `of`: the take and its input.
  TakeScores look(TakeEvidence of) const;
  // The measures of takes, compared with the real takes of the same style and content.
  static Metrics summarise(const Verdicts& all_scores, const Verdicts& real,
                           const std::optional<PoseError>& aligned);

  Classifier styles_, contents_;
  std::vector<Take> test_;
  std::map<StyleContent, Verdicts> references_;  // Of test_.
  StyleContentTable real_;
};

// Frechet distance of the normal distributions fitted to the rows of `a` and `b` (Heusel et al.
// 2017): |m_a - m_b|^2 + tr(S_a + S_b - 2 (S_a S_b)^(1/2)). Both need at least one row, and the
// same columns.
double frechet_distance(const torch::Tensor& a, const torch::Tensor& b);

}  // namespace panache
