// panache-lab eval: compares models with real motion.

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "base/file.h"
#include "eval/evaluate.h"
#include "eval/ood.h"
#include "eval/report.h"
#include "eval/systems/recorded.h"
#include "eval/systems/table.h"
#include "lab_verbs.h"
#include "manifests.h"
#include "messages.h"
#include "model_path.h"
#include "outputs.h"
#include "program.h"
#include "takes/manifest.h"

namespace panache::cli {
namespace {

struct EvalFlags {
  ManifestOptions data;
  std::vector<std::string> tests;
  std::vector<std::string> models;
  std::vector<std::string> unseen, splits;
  std::vector<std::string> ood;
  std::vector<std::string> systems;
  std::vector<std::string> recorded;
  std::string remover;
  std::string requests;
  std::string report;
  int64_t steps = 0;
  uint64_t seed = 1;
  bool force = false;
  bool json = false;
};

// The test takes of `tests`: those marked test, or all of a manifest that marks none. Excludes
// takes that are trained on, and styles that no training take shows.
std::vector<ManifestRow> read_tests(const std::vector<std::string>& tests,
                                    const Manifests& training) {
  std::set<std::string> learnt;
  for (const ManifestRow& row : training.rows) {
    if (!row.test) learnt.insert(std::filesystem::path(row.path).lexically_normal().string());
  }
  // Keeps the numbers of performers; without names, the order of the manifests identifies them.
  std::map<std::string, int> persons;
  for (const ManifestRow& row : training.rows) {
    if (!row.person.empty()) persons.try_emplace(row.person, row.set);
  }
  std::vector<ManifestRow> judged;
  int set = 0;
  for (const std::string& path : tests) {
    std::vector<ManifestRow> rows = need(read_manifest(path, set));
    set = next_set(rows);
    const bool marked = std::ranges::any_of(rows, &ManifestRow::test);
    for (ManifestRow& row : rows) {
      if (!persons.empty() && !row.person.empty()) {
        const int next = next_set(training.rows) + static_cast<int>(persons.size());
        row.set = persons.try_emplace(row.person, next).first->second;
      }
      if (marked && !row.test) continue;
      if (learnt.contains(std::filesystem::path(row.path).lexically_normal().string())) continue;
      row.test = true;
      judged.push_back(std::move(row));
    }
  }
  return rename_styles(training.styles, std::move(judged));
}

// The report identifies systems by their names.
void check_names(const EvalFlags& options, const EvaluateOptions& evaluation) {
  std::map<std::string, std::string> names;  // And their owners.
  for (size_t m = 0; m < evaluation.models.size(); ++m) {
    const auto [name, is_new] = names.try_emplace(evaluation.models[m].name, options.models[m]);
    if (is_new) continue;
    throw Failure{{options.models[m] + ": has the name of " + name->second +
                   "; the report names models by their files, so give one another name"},
                  kBadInput};
  }
  for (const SystemEntry& entry : evaluation.systems) {
    names.try_emplace(entry.name, "the judge's own system");
  }
  for (const std::string& folder : options.recorded) {
    const auto [name, is_new] = names.try_emplace(Recorded::name_of(folder), folder);
    if (is_new) continue;
    throw Failure{{folder + ": has the name of " + name->second +
                   "; the report names outputs by their folder, so give it another name"},
                  kBadInput};
  }
}

EvaluateOptions read_options(const EvalFlags& options) {
  EvaluateOptions evaluation;
  Manifests data = need(read_manifests(options.data));
  evaluation.styles = data.styles;
  if (options.tests.empty()) {
    for (const ManifestRow& row : data.rows) {
      if (row.test) evaluation.test.push_back(row);
    }
  } else {
    evaluation.test = read_tests(options.tests, data);
  }
  if (evaluation.test.empty()) {
    throw Failure{{options.tests.empty()
                       ? options.data.paths.front() +
                             ": marks no take as test; mark some in its column split, or give a "
                             "manifest of test takes with --test"
                       : options.tests.front() +
                             ": has no usable test take: all of them are trained on, or of styles "
                             "that the training manifests do not have"},
                  kBadInput};
  }
  evaluation.training = std::move(data.rows);
  evaluation.unlabelled = std::move(data.unlabelled);
  for (const std::string& path : options.models) {
    std::error_code status;
    const auto bytes = std::filesystem::file_size(path, status);
    evaluation.models.push_back(
        {std::filesystem::path(path).stem().string(), need(Model::load(path)), status ? 0 : bytes});
  }
  evaluation.walker_model = need(find_shipped(kWalkerModel));
  if (!options.remover.empty()) evaluation.remover = need(Model::load(options.remover));
  const Result<std::vector<SystemEntry>> published = find_published(options.systems);
  if (!published) throw Failure{located("--system", published.error()), kBadInput};
  evaluation.train_recipes = options.systems.empty() && options.recorded.empty();
  evaluation.systems.insert(evaluation.systems.end(), published->begin(), published->end());
  evaluation.recorded = options.recorded;
  check_names(options, evaluation);
  if (!options.unseen.empty()) {
    std::string name;
    for (const std::string& content : options.unseen) name += (name.empty() ? "" : "+") + content;
    evaluation.unseen.push_back({name, options.unseen});
  }
  for (const std::string& name : options.splits) {
    const Result<UnseenSplit> split = read_split(name);
    if (!split) throw Failure{located("--unseen-split", split.error()), kBadInput};
    evaluation.unseen.push_back(*split);
  }
  for (const std::string& path : options.ood) {
    for (const std::string& file : need(list_ood(path))) evaluation.ood.push_back(file);
  }
  if (options.steps > 0) evaluation.steps = options.steps;
  evaluation.seed = options.seed;
  return evaluation;
}

int run(const EvalFlags& options) {
  if (!options.report.empty()) {
    for (const char* name : {"report.json", "index.html"}) {
      need(check_free((std::filesystem::path(options.report) / name).string(), options.force));
    }
  }
  if (!options.requests.empty()) need(check_free(options.requests, options.force));
  const EvaluateOptions evaluation = read_options(options);
  const std::vector<ManifestRow> judged = rows_to_evaluate(evaluation);
  std::vector<ManifestRow> read = rows_to_train_on(evaluation.training, evaluation.unlabelled);
  read.insert(read.begin(), judged.begin(), judged.end());
  need(check_files(read));
  if (!options.requests.empty()) {
    need(write_file(options.requests, recorded_requests(judged), true));
    return kDone;
  }
  Report report = need(evaluate(evaluation));
  report.trained_on = options.data.paths;
  report.tested_on = options.tests.empty() ? options.data.paths : options.tests;
  if (!options.report.empty()) need(write_report(report, options.report));
  print(options.json ? report_json(report) : report_text(report));
  return kDone;
}

}  // namespace

void add_eval(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<EvalFlags>();
  CLI::App* verb = app.add_subcommand("eval", "Evaluate models against real motion");
  add_manifest_options(*verb, options->data)->required();
  const auto several = [&](const char* name, std::vector<std::string>& values,
                           const std::string& description) {
    verb->add_option(name, values, description + "; may be given several times")
        ->allow_extra_args(false);
  };
  several("--test", options->tests,
          "A manifest of test takes, instead of the test takes of the manifests");
  verb->add_option("--model", options->models,
                   "A model to evaluate; may be given several times; without any, and without "
                   "--system and --recorded, all recipes are trained first")
      ->allow_extra_args(false);
  verb->add_option("--remover", options->remover,
                   "A remover to evaluate alone: on styled test takes, and on out-of-distribution "
                   "motion that the --model restyled");
  several("--system", options->systems,
          "A system of another paper to build from the same takes and evaluate beside the models: "
          "xia2015, yumer2016, holden2017 or all");
  several("--unseen", options->unseen, "A content to leave out of training and then evaluate on");
  several("--unseen-split", options->splits,
          "The same for several contents with commas between them, or for a split of "
          "docs/evaluation.md: A, B or C");
  verb->add_option("--out-of-distribution", options->ood,
                   "A motion file, a folder of them or a manifest (of which contents without "
                   "a style are used): out-of-distribution motion to try every style on")
      ->allow_extra_args(false);
  several("--recorded", options->recorded,
          "A folder of motion that another program made of test takes, with a manifest.csv "
          "(input,style,strength,output): evaluated like a model");
  verb->add_option("--requests", options->requests,
                   "Evaluate nothing; write the manifest of inputs for --recorded, at "
                   "strength 1, for the other program to go through");
  verb->add_option("--report", options->report, "A folder for report.json and the page index.html");
  verb->add_option("--steps", options->steps, "Train this many steps instead of the recipes' own")
      ->check(in_range(1, 1000000000));
  verb->add_option("--seed", options->seed, "Seed of classifiers and training");
  verb->add_flag("--force", options->force, "Overwrite an existing report");
  verb->add_flag("--json", options->json, "Print the report as JSON");
  verb->footer(
      "Example:\n  panache-lab eval takes.csv --test others.csv --model mine.safetensors --report "
      "report");
  verb->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace panache::cli
