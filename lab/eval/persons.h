#pragma once
// Measures the persons of a model beside real people: are they told apart, do they differ by as
// much, and does other motion keep its quality?

#include <memory>
#include <string>
#include <vector>

#include "base/result.h"
#include "eval/metrics.h"
#include "eval/ood.h"
#include "eval/test_input.h"
#include "learn/neutral_bank.h"
#include "style/model.h"

namespace panache {

// How far people are apart: distances between the mean poses of pairs of them, the mean over the
// joints, cm.
struct PersonSpread {
  double median_cm = kNotMeasured, p90_cm = kNotMeasured;
};

struct RealPeople {
  size_t people = 0;
  PersonSpread spread;
  double own_cm = kNotMeasured;  // The same between two takes of one person, median.
  // A classifier trained on all but the last walk of each person tells the person on that.
  size_t told_of = 0;
  double told = kNotMeasured;
  double kept = kNotMeasured;  // Share of the variance of mean poses that six numbers carry.
};

struct SeedPersons {
  size_t seeds = 0, walks = 0;
  PersonSpread spread;  // On one walk.
  // A classifier trained on the seeds' other walks tells the seed on each.
  double told = kNotMeasured;
  // Share outside the ellipsoid that has 95 % of real people, by the six numbers that carry most of
  // what differs between their mean poses.
  double outside = kNotMeasured;
};

struct PersonsReport {
  RealPeople real;
  SeedPersons seeds;
  std::vector<OodRow> others;  // Every seed on every other motion; `style` is the seed.
};

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

// The motion of an input as the person of a seed, in the input's own time; with a style at strength
// 1 if `style` is one of the model's, and then without a person for seed -1.
Result<Take> play_person(const TestInput& input, const std::shared_ptr<const Model>& model,
                         int seed, float variety, int style = -1);

}  // namespace panache
