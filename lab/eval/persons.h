#pragma once
// Measures the persons of a model beside real people: are they told apart, do they differ by as
// much, and does other motion keep its quality?

#include <memory>
#include <string>
#include <vector>

#include "base/result.h"
#include "eval/ood.h"
#include "eval/performer_judges.h"
#include "eval/report_persons.h"
#include "eval/test_input.h"
#include "learn/neutral_bank.h"
#include "style/model/model.h"

namespace panache {

ChangeSummary summarize_changes(const std::vector<OodRow>& rows);

class PersonsMeasure {
 public:
  // `neutral`: takes of walks of many people, in layout positions, from files of one skeleton.
  // Others among them are ignored. `walks`: at least two, of people outside any training.
  static Result<PersonsMeasure> create(const std::vector<Take>& neutral,
                                       std::vector<TestInput> walks);

  const RealPeople& real() const { return real_; }
  // The persons of the seeds from 1 on, `variety` times as far from the mean person.
  Result<SeedPersons> measure(const std::shared_ptr<const Model>& model, int seeds,
                              float variety = 1) const;

 private:
  RealPeople real_;
  std::vector<std::vector<float>> directions_;  // Of the six numbers. [6][joints * 3]
  std::vector<double> variances_;               // [6]
  std::vector<TestInput> walks_;
};

// How well two plain walks of one person agree on that person's numbers: the correlation of each
// number over the people, from the first and from the last of their takes that are given.
// [axes]; `people`: how many have two.
Result<std::vector<double>> measure_retelling(const std::shared_ptr<const Model>& model,
                                              const NeutralBank& bank,
                                              const std::vector<Take>& neutral, size_t& people);

// The persons of seeds on other motion, compared frame by frame with the input.
Result<std::vector<OodRow>> measure_persons_on(const std::vector<TestInput>& inputs,
                                               const std::shared_ptr<const Model>& model, int seeds,
                                               float variety = 1);

// `styles`: of the neutral take of the same index, those to be judged; persons of `seeds` seeds.
Result<StyledPersons> measure_styled_persons(const std::vector<TestInput>& neutral,
                                             const std::vector<std::vector<std::string>>& styles,
                                             const PerformerJudges& judges,
                                             const std::shared_ptr<const Model>& model, int seeds);

// The motion of an input as the person of a seed, in the input's own time; with a style at strength
// 1 if `style` is one of the model's, and then without a person for seed -1.
Result<Take> play_person(const TestInput& input, const std::shared_ptr<const Model>& model,
                         int seed, float variety, int style = -1);

}  // namespace panache
