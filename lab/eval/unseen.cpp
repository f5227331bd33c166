#include <algorithm>

#include "eval/evaluate.h"
#include "eval/report_numbers.h"
#include "eval/systems/mean_posture.h"
#include "eval/systems/model_system.h"
#include "takes/manifest.h"

namespace panache {
namespace {

bool is_among(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

// Accuracy of a classifier without these contents in training on real takes of them: the best that
// the training takes allow.
MetricsTable evaluate_blind(const UnseenSplit& split, const TestSet& test_set, uint64_t seed) {
  std::vector<Take> known;
  std::vector<std::string> labels;
  for (const Take& take : test_set.training.takes) {
    if (is_among(split.contents, take.row.content)) continue;
    known.push_back(take);
    labels.push_back(take.row.style);
  }
  const Classifier blind(known, labels, test_set.evaluator.styles().classes(), seed);
  StyleContentTable cells;
  std::map<StyleContent, double> hits;
  for (const Take& take : test_set.evaluator.test()) {
    const StyleContent cell{take.row.style, take.row.content};
    if (!is_among(split.contents, cell.second)) continue;
    const torch::Tensor best = blind.classify(take).probabilities.argmax(1);
    Metrics& metrics = cells[cell];
    ++metrics.takes;
    metrics.windows += static_cast<size_t>(best.size(0));
    hits[cell] += best.eq(blind.find(take.row.style)).sum().item<double>();
  }
  for (auto& [cell, metrics] : cells) {
    metrics["style_accuracy"] = hits[cell] / static_cast<double>(metrics.windows);
  }
  return by_content(cells);
}

// The same by performers' classifiers.
std::vector<ClipVerdict> judge_blind(const UnseenSplit& split, const TestSet& test_set) {
  std::vector<Take> known, unseen;
  for (const Take& take : test_set.training.takes) {
    if (!is_among(split.contents, take.row.content)) known.push_back(take);
  }
  for (const Take& take : test_set.evaluator.test()) {
    if (is_among(split.contents, take.row.content)) unseen.push_back(take);
  }
  return PerformerJudges(known, unseen).real();
}

}  // namespace

Result<UnseenSplit> read_split(const std::string& text) {
  const std::vector<UnseenSplit> splits = {
      {"A", {"run", "wave-left-hand", "walk-turn-left"}},
      {"B",
       {"wave-both-hands", "wave-left-hand", "wave-right-hand", "walk-turn-left",
        "walk-turn-right"}},
      {"C", {"raise-up-both-hands", "raise-up-left-hand", "raise-up-right-hand", "walk"}}};
  for (const UnseenSplit& split : splits) {
    if (split.name == text) return split;
  }
  UnseenSplit split;
  for (size_t begin = 0; begin <= text.size();) {
    const size_t end = std::min(text.find(',', begin), text.size());
    const std::string content = text.substr(begin, end - begin);
    if (content.empty() || is_among(split.contents, content)) {
      return Error{"split '" + text +
                   "'; expected A, B or C, or different contents with commas between them"};
    }
    split.contents.push_back(content);
    split.name += (begin == 0 ? "" : "+") + content;
    begin = end + 1;
  }
  return split;
}

Result<void> evaluate_unseen(const UnseenSplit& split, const EvaluateOptions& options,
                             const TestSet& test_set, const std::vector<NamedModel>& models,
                             std::vector<SystemReport>& reports) {
  // The input normalisation comes from the takes of the pairs only, so it excludes these contents.
  TrainingData training_data = test_set.training;
  std::erase_if(training_data.pairings, [&](const Pairing& pairing) {
    return is_among(split.contents, test_set.training.takes[pairing.styled].row.content);
  });
  // Styles shown only in these contents are not learnt.
  EvaluateOptions learnt = options;
  std::erase_if(learnt.styles, [&](const StyleName& style) {
    return std::none_of(training_data.pairings.begin(), training_data.pairings.end(),
                        [&](const Pairing& pairing) {
                          return training_data.takes[pairing.styled].row.style == style.name;
                        });
  });
  const MetricsTable blind = evaluate_blind(split, test_set, options.seed);
  const SystemData data = system_data(training_data, learnt);
  Result<std::unique_ptr<System>> posture = make_mean_posture("mean posture", data);
  if (!posture) return posture.error();
  Result<ContentsEvaluation> mean_posture = evaluate_contents(**posture, test_set, split.contents);
  if (!mean_posture) return mean_posture.error();
  const std::vector<ClipVerdict> blind_clips = judge_blind(split, test_set);
  const auto add = [&](SystemReport& system, const ContentsEvaluation& evaluation) {
    UnseenReport report;
    report.name = split.name;
    report.mean = mean_metrics(evaluation.cells);
    report.by_content = by_content(evaluation.cells);
    report.clips = evaluation.clips;
    report.mean_posture_clips = mean_posture->clips;
    report.blind_clips = blind_clips;
    for (const ClipVerdict& clip : styled_clips(test_set.performers.real())) {
      if (is_among(split.contents, clip.content)) report.real_clips.push_back(clip);
    }
    for (const std::string& content : split.contents) {
      const auto seen = system.by_content.find(content);
      if (seen != system.by_content.end()) report.seen_by_content.insert(*seen);
    }
    report.blind_by_content = blind;
    report.mean_posture_by_content = by_content(mean_posture->cells);
    system.unseen.push_back(std::move(report));
  };

  std::map<const Recipe*, ContentsEvaluation>
      evaluated;  // All models of a recipe share one training.
  for (size_t s = 0; s < models.size(); ++s) {
    const Recipe* recipe = &models[s].model->recipe();
    if (!evaluated.contains(recipe)) {
      Result<NamedModel> model = train_system(*recipe, models[s].name, training_data, learnt);
      if (!model) return located("unseen " + split.name, model.error());
      Result<ContentsEvaluation> evaluation =
          evaluate_contents(ModelSystem(model->name, model->model), test_set, split.contents);
      if (!evaluation) return evaluation.error();
      evaluated[recipe] = *std::move(evaluation);
    }
    add(reports[s], evaluated[recipe]);
  }
  for (size_t s = 0; s < options.systems.size(); ++s) {
    if (options.systems[s].make == make_mean_posture) continue;
    Result<std::unique_ptr<System>> system = options.systems[s].make(options.systems[s].name, data);
    if (!system) return located("unseen " + split.name, system.error());
    Result<ContentsEvaluation> evaluation = evaluate_contents(**system, test_set, split.contents);
    if (!evaluation) return evaluation.error();
    add(reports[models.size() + s], *evaluation);
  }
  return {};
}

}  // namespace panache
