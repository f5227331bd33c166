#include "eval/evaluate.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <set>

#include "base/parallel.h"
#include "base/progress.h"
#include "base/text.h"
#include "eval/arrival.h"
#include "eval/disturbances.h"
#include "eval/motion_metrics.h"
#include "eval/ood.h"
#include "eval/persons.h"
#include "eval/prediction.h"
#include "eval/report_numbers.h"
#include "eval/style_judges.h"
#include "eval/systems/mean_posture.h"
#include "eval/systems/model_system.h"
#include "eval/systems/recorded.h"
#include "takes/load_takes.h"
#include "takes/manifest.h"
#include "train/persons.h"

namespace panache {
namespace {

Result<TestSet> prepare(const EvaluateOptions& options) {
  Result<TrainingData> training =
      prepare_training(options.training, PoseLayout::positions, options.unlabelled);
  if (!training) return training.error();
  std::vector<ManifestRow> neutral, styled;
  for (const ManifestRow& row : rows_to_evaluate(options))
    (row.neutral ? neutral : styled).push_back(row);
  if (neutral.empty())
    return Error{
        "no neutral test take of a content that is trained on; expected rows with neutral 1"};
  if (styled.empty())
    return Error{
        "no styled test take of a style and content that are trained on; expected rows with "
        "neutral 0"};
  Progress progress("reading test takes");
  Result<std::vector<TestInput>> inputs = load_inputs(neutral);
  if (!inputs) return inputs.error();
  Result<std::vector<TestInput>> styled_inputs = load_inputs(styled);
  if (!styled_inputs) return styled_inputs.error();
  std::vector<ManifestRow> walks;
  for (const ManifestRow& row : options.unlabelled) {
    if (row.test && row.content == kWalk) walks.push_back(row);
  }
  Result<std::vector<TestInput>> others = load_inputs(walks);
  if (!others) return others.error();
  std::vector<TestInput> walker;
  if (!options.walker_model.empty()) {
    Result<std::vector<TestInput>> made = walker_walks(options.walker_model);
    if (!made) return made.error();
    walker = *std::move(made);
  }
  std::vector<Take> test;
  std::set<std::string> styles;
  for (const std::vector<TestInput>* part : {&*inputs, &*styled_inputs}) {
    for (const TestInput& input : *part) test.push_back(input.take);
  }
  for (const ManifestRow& row : styled) styles.insert(row.style);
  progress.update(0.5, "training the classifiers");
  Evaluator evaluator = Evaluator::create(training->takes, test, options.seed);
  const double units = 1 / styled_inputs->front().rig.scale();
  PerformerJudges performers(training->takes, test);
  return TestSet{*std::move(training),
                 *std::move(inputs),
                 *std::move(styled_inputs),
                 *std::move(others),
                 std::move(walker),
                 AlignedTakes(std::move(test)),
                 std::move(evaluator),
                 std::move(performers),
                 {styles.begin(), styles.end()},
                 units};
}

Result<std::vector<NamedModel>> find_models(const EvaluateOptions& options,
                                            const TestSet& test_set) {
  if (!options.models.empty() || !options.train_recipes) return options.models;
  std::vector<NamedModel> models;
  for (const Recipe* recipe : recipes()) {
    Result<NamedModel> model = train_system(*recipe, recipe->name, test_set.training, options);
    if (!model) return model.error();
    models.push_back(*std::move(model));
  }
  return models;
}

// All test takes, neutral and styled, and all out-of-distribution clips as one content.
Result<std::vector<PredictionRow>> evaluate_prediction(const std::shared_ptr<const Model>& model,
                                                       const TestSet& test_set,
                                                       const EvaluateOptions& options) {
  std::vector<const Take*> takes;
  for (const std::vector<TestInput>* part : {&test_set.inputs, &test_set.styled}) {
    for (const TestInput& input : *part) takes.push_back(&input.take);
  }
  std::vector<ManifestRow> rows;
  rows.reserve(options.ood.size());
  for (const std::string& path : options.ood) {
    rows.push_back({path, "", "(foreign motion)", "", true, true, 0});
  }
  Result<std::vector<Take>> ood = load_takes(rows, PoseLayout::positions);
  if (!ood) return ood.error();
  for (const Take& take : *ood) takes.push_back(&take);
  return measure_prediction(model, takes);
}

// Persons on a walk of each person without styles and on one of the walker, on the neutral test
// takes in their performers' styles, and on out-of-distribution motion. Nothing where too few
// people walk.
Result<std::optional<PersonsReport>> evaluate_persons(const std::shared_ptr<const Model>& model,
                                                      const TestSet& test_set,
                                                      const EvaluateOptions& options) {
  constexpr int kSeeds = 20, kStyledSeeds = 10, kOtherSeeds = 3;
  std::vector<Take> neutral;
  for (const std::vector<Take>* part : {&test_set.training.takes, &test_set.training.unlabelled}) {
    std::ranges::copy_if(*part, std::back_inserter(neutral),
                         [](const Take& take) { return take.row.neutral; });
  }
  std::vector<TestInput> walks;
  for (const TestInput& walk : test_set.others) {
    if (std::ranges::none_of(walks, [&](const TestInput& other) {
          return person_of(other.take) == person_of(walk.take);
        })) {
      walks.push_back(walk);
    }
  }
  if (!test_set.walker.empty()) walks.push_back(test_set.walker.front());
  const Result<PersonsMeasure> measure = PersonsMeasure::create(neutral, std::move(walks));
  if (!measure) return std::optional<PersonsReport>();
  PersonsReport report;
  report.real = measure->real();
  const Result<SeedPersons> seeds = measure->measure(model, kSeeds);
  if (!seeds) return seeds.error();
  report.seeds = *seeds;

  std::vector<std::vector<std::string>> styles;
  for (const TestInput& input : test_set.inputs) {
    std::ranges::copy_if(
        test_set.styles, std::back_inserter(styles.emplace_back()),
        [&](const std::string& style) { return test_set.is_shown(style, input.take.row.set); });
  }
  const Result<StyledPersons> styled =
      measure_styled_persons(test_set.inputs, styles, test_set.performers, model, kStyledSeeds);
  if (!styled) return styled.error();
  report.styled = *styled;

  std::vector<ManifestRow> rows;
  for (const std::string& file : options.ood) rows.emplace_back().path = file;
  const Result<std::vector<TestInput>> others = load_inputs(rows);
  if (!others) return others.error();
  const Result<std::vector<OodRow>> changes = measure_persons_on(*others, model, kOtherSeeds);
  if (!changes) return changes.error();
  report.others = summarize_changes(*changes);
  return std::optional(report);
}

using Systems = std::vector<std::unique_ptr<System>>;

// The inputs and styles that recorded outputs may have.
Result<Systems> read_recorded(const EvaluateOptions& options) {
  Systems systems;
  if (options.recorded.empty()) return systems;
  RecordedScope scope;
  std::set<std::string> styles;
  for (const ManifestRow& row : rows_to_evaluate(options)) {
    scope.inputs.push_back(row.path);
    if (!row.neutral) styles.insert(row.style);
  }
  scope.inputs.insert(scope.inputs.end(), options.ood.begin(), options.ood.end());
  scope.styles.assign(styles.begin(), styles.end());
  for (const std::string& folder : options.recorded) {
    Result<std::unique_ptr<Recorded>> recorded = Recorded::load(folder, scope);
    if (!recorded) return recorded.error();
    systems.push_back(*std::move(recorded));
  }
  return systems;
}

Result<Systems> make_comparisons(const EvaluateOptions& options, const TestSet& test_set) {
  Systems systems;
  const SystemData data = system_data(test_set.training, options);
  for (const SystemEntry& entry : options.systems) {
    Result<std::unique_ptr<System>> system = entry.make(entry.name, data);
    if (!system) return system.error();
    systems.push_back(*std::move(system));
  }
  return systems;
}

Result<SystemReport> judge_fully(const System& system, const TestSet& test_set,
                                 const StyleJudges* judges, const EvaluateOptions& options) {
  Result<SystemReport> report = evaluate_system(system, test_set);
  if (!report) return report;
  report->disturbances = measure_disturbances(test_set.aligned, system);
  Result<std::vector<StyleArrival>> arrival =
      WalkSet(test_set.training.takes, test_set.evaluator.test(), test_set.inputs, test_set.others,
              test_set.walker)
          .measure(system);
  if (!arrival) return arrival.error();
  report->arrival = *std::move(arrival);
  if (!options.ood.empty()) {
    Progress progress("foreign motion, " + system.name());
    Result<std::vector<OodRow>> ood =
        measure_ood(options.ood, system, judges, [&](double share) { progress.update(share); });
    if (!ood) return ood.error();
    report->ood = *std::move(ood);
  }
  const std::shared_ptr<const Model> model = system.model();
  if (model && model->predictor()) {
    Result<std::vector<PredictionRow>> prediction = evaluate_prediction(model, test_set, options);
    if (!prediction) return prediction.error();
    report->prediction = *std::move(prediction);
  }
  if (model && model->persons()) {
    Progress progress("persons of " + system.name());
    Result<std::optional<PersonsReport>> persons = evaluate_persons(model, test_set, options);
    if (!persons) return persons.error();
    report->persons = *std::move(persons);
  }
  const SystemFacts facts = system.facts();
  report->recipe = facts.recipe;
  report->model_bytes = facts.bytes;
  report->parameters = facts.parameters;
  report->recorded = facts.recorded;
  return report;
}

// Results of the classifiers for out-of-distribution motion on real test takes, and on the clips
// themselves.
Result<void> judge_ood_references(const TestSet& test_set, const StyleJudges& judges,
                                  const EvaluateOptions& options, Report& report) {
  std::vector<OodRow> real;
  for (const Take& take : test_set.evaluator.test()) {
    OodRow& row = real.emplace_back();
    row.verdict = judges.judge_real(take);
  }
  report.ood_real = summarize_styles(real);
  // They are not outputs of one clip in all styles.
  report.ood_real.forced_mlp = report.ood_real.forced_lda = kNotMeasured;
  report.ood_real_unseen =
      summarize_styles(judge_unseen_actions(test_set.training.takes, options.seed + 5));
  SignatureMatch left_out;
  for (const StyleName& style : options.styles) {
    const Signature* signature = judges.signature(style.name);
    if (!signature) continue;
    report.signatures.push_back({style.name, *signature, judges.real_signature(style.name)});
    left_out += report.signatures.back().left_out;
  }
  report.ood_real.signature_sign = left_out.sign_share();
  report.ood_real.signature_amount = left_out.amount_share();

  std::vector<ManifestRow> rows;
  for (const std::string& file : options.ood) rows.emplace_back().path = file;
  Result<std::vector<Take>> clips = load_takes(rows, PoseLayout::positions);
  if (!clips) return clips.error();
  std::vector<OodRow> input(clips->size() * options.styles.size());
  parallel_for(static_cast<int>(input.size()), [&](int i) {
    const Take& clip = (*clips)[i / options.styles.size()];
    const std::string& style = options.styles[i % options.styles.size()].name;
    input[i].clip = clip.row.path;
    input[i].style = style;
    input[i].verdict = judges.judge(clip, clip, 0, style);
  });
  report.ood_input = summarize_styles(input);
  return {};
}

// Contents to hold out need styled test takes, because these are evaluated.
Result<void> check_unseen(const EvaluateOptions& options) {
  std::set<std::string> contents;
  for (const ManifestRow& row : rows_to_evaluate(options)) {
    if (!row.neutral) contents.insert(row.content);
  }
  for (const UnseenSplit& split : options.unseen) {
    for (const std::string& content : split.contents) {
      if (contents.contains(content)) continue;
      return Error{"unseen content '" + content +
                   "' has no styled test take; expected contents of the styled test takes: " +
                   one_of(contents, ", ")};
    }
  }
  return {};
}

// The reference lines of all systems: real takes, and the neutral takes themselves.
void judge_references(const TestSet& test_set, Report& report) {
  const StyleContentTable& real = test_set.evaluator.real();
  report.real = mean_metrics(real);
  report.real_by_content = by_content(real);
  report.real_by_style = by_style(real);
  const StyleContentTable input =
      test_set.evaluator.evaluate(untouched(test_set.inputs, test_set.styles),
                                  takes_of(test_set.inputs), test_set.aligned.untouched_errors());
  report.input = mean_metrics(input);
  report.input_by_content = by_content(input);
  report.real_clips = test_set.performers.real();
  report.real_clips_across = test_set.performers.judge_across(test_set.evaluator.test());
  report.sc_floor = report.cc_floor =
      distance_to_real(test_set.evaluator.test(), test_set.training.takes,
                       test_set.evaluator.test()) *
      test_set.units_per_metre;
}

}  // namespace

std::vector<ManifestRow> rows_to_evaluate(const EvaluateOptions& options) {
  std::set<std::string> styles, contents;
  for (const ManifestRow& row : options.training) {
    if (row.test) continue;
    styles.insert(row.style);
    contents.insert(row.content);
  }
  std::vector<ManifestRow> rows;
  for (const ManifestRow& row : options.test) {
    if (styles.contains(row.style) && contents.contains(row.content)) rows.push_back(row);
  }
  return rows;
}

SystemData system_data(const TrainingData& training, const EvaluateOptions& options) {
  return {training.takes, training.pairings, options.styles, options.seed, training.unlabelled};
}

Result<NamedModel> train_system(const Recipe& recipe, const std::string& name,
                                const TrainingData& data, const EvaluateOptions& options) {
  TrainOptions training(recipe);
  if (options.steps) training.settings.steps = *options.steps;
  training.settings.predictor_steps = 0;  // Not needed for this evaluation.
  training.seed = options.seed;
  Result<Trained> trained = train(data, options.styles, training);
  if (!trained) return trained.error();
  Result<std::shared_ptr<const Model>> model = Model::create(trained->model, name);
  if (!model) return model.error();
  return NamedModel{name, *model};
}

Result<Report> evaluate(const EvaluateOptions& options) {
  const Stopwatch watch;
  // First, because checking them is fast.
  Result<Systems> recorded = read_recorded(options);
  if (!recorded) return recorded.error();
  if (Result<void> shown = check_unseen(options); !shown) return shown.error();
  Result<TestSet> test_set = prepare(options);
  if (!test_set) return test_set.error();
  if (options.remover) {
    Report report;
    report.styles = test_set->styles;
    report.contents = test_set->evaluator.contents().classes();
    judge_references(*test_set, report);
    Result<RemovalReport> removal =
        measure_removal(options.remover, options.models.empty() ? nullptr : options.models[0].model,
                        *test_set, options.ood);
    if (!removal) return removal.error();
    report.removal = *removal;
    report.seconds = watch.seconds();
    return report;
  }
  Result<std::vector<NamedModel>> models = find_models(options, *test_set);
  if (!models) return models.error();
  Result<Systems> comparisons = make_comparisons(options, *test_set);
  if (!comparisons) return comparisons.error();

  Systems systems;
  std::vector<const System*> drawn;
  for (const NamedModel& model : *models) {
    systems.push_back(std::make_unique<ModelSystem>(model.name, model.model, model.bytes));
    drawn.push_back(systems.back().get());
  }
  for (size_t s = 0; s < comparisons->size(); ++s) {
    if (options.systems[s].make != make_mean_posture) drawn.push_back((*comparisons)[s].get());
  }
  for (const std::unique_ptr<System>& system : *recorded) drawn.push_back(system.get());
  for (Systems* part : {&*comparisons, &*recorded}) {
    std::move(part->begin(), part->end(), std::back_inserter(systems));
  }

  Report report;
  report.styles = test_set->styles;
  report.contents = test_set->evaluator.contents().classes();
  report.style_floor = options.floor.style;
  report.content_floor = options.floor.content;
  judge_references(*test_set, report);
  std::optional<StyleJudges> judges;
  if (!options.ood.empty()) {
    Progress progress("training the judges of out-of-distribution motion");
    judges.emplace(test_set->training.takes, test_set->training.pairings, options.seed + 5);
    if (Result<void> done = judge_ood_references(*test_set, *judges, options, report); !done) {
      return done.error();
    }
  }
  for (const std::unique_ptr<System>& system : systems) {
    Result<SystemReport> evaluated =
        judge_fully(*system, *test_set, judges ? &*judges : nullptr, options);
    if (!evaluated) return evaluated.error();
    report.systems.push_back(*std::move(evaluated));
  }
  for (const UnseenSplit& split : options.unseen) {
    if (Result<void> done = evaluate_unseen(split, options, *test_set, *models, report.systems);
        !done) {
      return done.error();
    }
  }
  if (Result<void> done = add_pictures(drawn, *test_set, report); !done) return done.error();
  report.seconds = watch.seconds();
  return report;
}

}  // namespace panache
