#pragma once
// The whole evaluation: classifiers are trained, systems are run, their motion is judged.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "eval/aligned_takes.h"
#include "eval/evaluator.h"
#include "eval/performer_judges.h"
#include "eval/report.h"
#include "eval/system.h"
#include "eval/systems/table.h"
#include "train/trainer.h"

namespace panache {

// Contents that are left out of training, to be judged apart.
struct UnseenSplit {
  std::string name;
  std::vector<std::string> contents;
};
// A, B or C: the splits of docs/evaluation.md. Anything else is a list of contents with commas
// between them; it fails where one of them is empty or named twice.
Result<UnseenSplit> read_split(const std::string& text);

struct NamedModel {
  std::string name;
  std::shared_ptr<const Model> model;
  size_t bytes = 0;  // Of its file.
};

struct EvaluateOptions {
  std::vector<ManifestRow> training;    // Styles renamed; rows marked test are not learnt from.
  std::vector<ManifestRow> unlabelled;  // For recipes that guidance trains.
  std::vector<ManifestRow> test;        // Real held-out takes, neutral and styled.
  std::vector<StyleName> styles;        // Of `training`.
  std::vector<NamedModel> models;
  // Evaluated alone where it is given; the first model restyles what it takes the style off again.
  std::shared_ptr<const Model> remover;
  bool train_recipes = true;  // All of them, where there are no models.
  // What the models are compared with.
  std::vector<SystemEntry> systems = comparison_systems();
  std::vector<std::string> recorded;  // Folders of outputs of other programs, see Recorded.
  std::vector<UnseenSplit> unseen;
  std::vector<std::string> ood;  // Motion files.
  AccuracyFloor floor;
  std::optional<int64_t> steps;  // Of every training, instead of its recipe's own.
  uint64_t seed = 1;
};

// The test takes whose style and content a training take shows: nothing can be said of the others.
std::vector<ManifestRow> rows_to_evaluate(const EvaluateOptions& options);

// Fails where takes cannot be read, or where the test takes lack what is judged. Shows its progress
// on a terminal.
Result<Report> evaluate(const EvaluateOptions& options);

// The test takes and everything that judges motion made from them.
struct TestSet {
  TrainingData training;          // Takes and pairs of the training split.
  std::vector<TestInput> inputs;  // Neutral test takes,
  std::vector<TestInput> styled;  // and styled ones.
  AlignedTakes aligned;
  Evaluator evaluator;
  PerformerJudges performers;
  std::vector<std::string> styles;  // That have real test takes, in order.
  double units_per_metre = 1;       // Of the first test file: the unit of CC and SC++.
};

// What the systems that models are compared with may learn from.
SystemData system_data(const TrainingData& training, const EvaluateOptions& options);

// A recipe's networks, trained on `data` with the steps and seed of `options`.
Result<NamedModel> train_system(const Recipe& recipe, const std::string& name,
                                const TrainingData& data, const EvaluateOptions& options);

// What one system makes of the test takes in every way that it can be asked: seen contents,
// strengths, mixes.
Result<SystemReport> evaluate_system(const System& system, const TestSet& test_set);

// The same of these contents only, at strength 1.
struct ContentsEvaluation {
  StyleContentTable cells;
  std::vector<ClipVerdict> clips;  // Before the judges of the performers.
};
Result<ContentsEvaluation> evaluate_contents(const System& system, const TestSet& test_set,
                                             const std::vector<std::string>& contents);

// Trains the recipes of `models` and builds the systems of `options` without the contents of
// `split`, which have test takes, judges them, and adds what was found to the first reports, in the
// same order. The mean posture stands beside each of them instead.
Result<void> evaluate_unseen(const UnseenSplit& split, const EvaluateOptions& options,
                             const TestSet& test_set, const std::vector<NamedModel>& models,
                             std::vector<SystemReport>& reports);

// Skeletons and planted feet of some takes: input, systems, real take.
Result<void> add_pictures(const std::vector<const System*>& systems, const TestSet& test_set,
                          Report& report);

}  // namespace panache
