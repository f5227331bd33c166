#pragma once
// Compares motion that a system put out with real held-out takes.

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "base/result.h"
#include "eval/classifier.h"
#include "eval/quality.h"
#include "learn/take.h"

namespace panache {

// What a system made of a neutral take. `take.row` names the style asked for and the content.
struct Output {
  Take take;
  int input = 0;                     // Index of the neutral take.
  std::vector<float> source_frames;  // Frame of the input per frame of the take.
};

// Per style and content.
using Cell = std::pair<std::string, std::string>;
using CellTable = std::map<Cell, Quality>;

// Means of a table: over all cells, or per content or style.
Quality mean_quality(const CellTable& cells);
QualityTable by_content(const CellTable& cells);
QualityTable by_style(const CellTable& cells);
// The cells of these contents only.
CellTable of_contents(const CellTable& cells, const std::vector<std::string>& contents);

// Below these shares of real held-out windows the classifiers may not judge others.
struct JudgeFloor {
  double style = 0.95, content = 0.90;
};

class Judge {
 public:
  // `training`: takes the classifiers learn from; `test`: real takes they do not; numbers in layout
  // positions. Styles and contents to tell apart are those of `test`, "neutral" included. Fails
  // where real test takes score below the floor: then no accuracy means anything.
  static Result<Judge> create(const std::vector<Take>& training, std::vector<Take> test,
                              const JudgeFloor& floor, uint64_t seed);

  // Real styled test takes, judged like outputs.
  const CellTable& real() const { return real_; }
  // Judges outputs whose style and content have a real take in `test`; others are left out.
  // `inputs`: the neutral takes that outputs refer to. Pose errors are not filled in.
  CellTable judge(const std::vector<Output>& outputs, const std::vector<Take>& inputs) const;

  const Classifier& styles() const { return styles_; }
  const Classifier& contents() const { return contents_; }
  // The styled test takes.
  const std::vector<Take>& test() const { return test_; }

 private:
  // What real takes of a cell are like.
  struct Reference {
    double jerk = 0, cadence = kNotMeasured;
    torch::Tensor features;
  };
  // One take, judged by itself.
  struct Verdict {
    size_t windows = 0;
    double style = 0, content = 0;  // Windows recognised as what the row says.
    double probability = 0;
    double jerk = 0, skating = 0, slide = 0, cadence = kNotMeasured, distance = kNotMeasured;
    torch::Tensor features;
  };
  Judge(Classifier styles, Classifier contents, std::vector<Take> test);
  Verdict look(const Take& take) const;
  // Means of the verdicts of one cell.
  Quality summarise(const std::vector<const Verdict*>& verdicts, const Reference& reference) const;
  static Reference refer(const std::vector<const Verdict*>& verdicts);

  Classifier styles_, contents_;
  std::vector<Take> test_;
  std::map<Cell, Reference> references_;
  CellTable real_;
};

}  // namespace panache
