#pragma once
// The complete evaluation: trains classifiers, runs systems and measures their motion.

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
#include "takes/manifest.h"
#include "train/trainer.h"

namespace panache {

// Contents to hold out from training, to be evaluated as unseen.
struct UnseenSplit {
  std::string name;
  std::vector<std::string> contents;
};
// A, B or C: the splits of docs/evaluation.md. Otherwise a comma-separated list of contents; fails
// if one is empty or repeated.
Result<UnseenSplit> read_split(const std::string& text);

struct NamedModel {
  std::string name;
  std::shared_ptr<const Model> model;
  size_t bytes = 0;  // File size.
};

struct EvaluateOptions {
  std::vector<ManifestRow> training;    // Styles renamed; rows marked test are not trained on.
  std::vector<ManifestRow> unlabelled;  // For recipes with guidance.
  std::vector<ManifestRow> test;        // Real held-out takes, neutral and styled.
  std::vector<StyleName> styles;        // The styles of `training`.
  std::vector<NamedModel> models;
  // If given, only this is evaluated; the first model restyles the motion that it removes styles
  // from.
  std::shared_ptr<const Model> remover;
  bool train_recipes = true;  // All recipes, if there are no models.
  // Systems to compare the models with.
  std::vector<SystemEntry> systems = comparison_systems();
  std::vector<std::string> recorded;  // Folders of other programs' outputs, see Recorded.
  std::vector<UnseenSplit> unseen;
  std::vector<std::string> ood;  // Motion files.
  std::string walker_model;      // File of the walker, whose walks are restyled too; or empty.
  AccuracyFloor floor;
  std::optional<int64_t> steps;  // For every training, instead of the recipe's own.
  uint64_t seed = 1;
};

// The test takes whose style and content occur in training; others cannot be evaluated.
std::vector<ManifestRow> rows_to_evaluate(const EvaluateOptions& options);

// Fails if takes cannot be read, or if the test takes are insufficient. Shows progress on a
// terminal.
Result<Report> evaluate(const EvaluateOptions& options);

// The test takes, and all evaluators made from them.
struct TestSet {
  TrainingData training;          // Takes and pairs of the training split.
  std::vector<TestInput> inputs;  // Neutral test takes,
  std::vector<TestInput> styled;  // and styled ones.
  std::vector<TestInput> others;  // Walks of people without styles,
  std::vector<TestInput> walker;  // and of the program's walker.
  AlignedTakes aligned;
  Evaluator evaluator;
  PerformerJudges performers;
  std::vector<std::string> styles;  // With real test takes, in order.
  double units_per_metre = 1;       // Of the first test file, for the unit of CC and SC++.

  // Whether a real test take of this set shows the style: each set has its own neutral.
  bool is_shown(const std::string& style, int set) const;
};

// The training data of the systems that models are compared with.
SystemData system_data(const TrainingData& training, const EvaluateOptions& options);

// The networks of a recipe, trained on `data` with the steps and seed of `options`.
Result<NamedModel> train_system(const Recipe& recipe, const std::string& name,
                                const TrainingData& data, const EvaluateOptions& options);

// Runs one system on the test takes in every supported way: seen contents, strengths, mixes.
Result<SystemReport> evaluate_system(const System& system, const TestSet& test_set);

// Runs it on these contents only, at strength 1.
struct ContentsEvaluation {
  StyleContentTable cells;
  std::vector<ClipVerdict> clips;  // As seen by the performers' classifiers.
};
Result<ContentsEvaluation> evaluate_contents(const System& system, const TestSet& test_set,
                                             const std::vector<std::string>& contents);

// Retrains the recipes of `models` and the systems of `options` without the contents of `split`,
// which need test takes, evaluates them, and adds the results to the first reports, in the same
// order. Next to each stands the mean posture, not as a system of its own.
Result<void> evaluate_unseen(const UnseenSplit& split, const EvaluateOptions& options,
                             const TestSet& test_set, const std::vector<NamedModel>& models,
                             std::vector<SystemReport>& reports);

// Skeletons and foot contacts of some takes: input, systems, real take.
Result<void> add_pictures(const std::vector<const System*>& systems, const TestSet& test_set,
                          Report& report);

}  // namespace panache
