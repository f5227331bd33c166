#include <algorithm>

#include "eval/evaluate.h"
#include "eval/systems/mean_posture.h"
#include "eval/systems/model_system.h"

namespace panache {
namespace {

bool is_among(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

// How well real takes of the contents are told apart by a classifier that never saw them: what the
// training takes say about them at all.
QualityTable judge_blind(const UnseenSplit& split, const Bench& bench, uint64_t seed) {
  std::vector<Take> known;
  std::vector<std::string> labels;
  for (const Take& take : bench.training.takes) {
    if (is_among(split.contents, take.row.content)) continue;
    known.push_back(take);
    labels.push_back(take.row.style);
  }
  const Classifier blind(known, labels, bench.judge.styles().classes(), seed);
  CellTable cells;
  std::map<Cell, double> hits;
  for (const Take& take : bench.judge.test()) {
    const Cell cell{take.row.style, take.row.content};
    if (!is_among(split.contents, cell.second)) continue;
    const torch::Tensor best = blind.judge(take).probabilities.argmax(1);
    Quality& quality = cells[cell];
    ++quality.takes;
    quality.windows += static_cast<size_t>(best.size(0));
    hits[cell] += best.eq(blind.find(take.row.style)).sum().item<double>();
  }
  for (auto& [cell, quality] : cells) {
    quality["style_accuracy"] = hits[cell] / static_cast<double>(quality.windows);
  }
  return by_content(cells);
}

}  // namespace

Result<UnseenSplit> named_split(const std::string& name) {
  const std::vector<UnseenSplit> splits = {
      {"A", {"run", "wave-left-hand", "walk-turn-left"}},
      {"B",
       {"wave-both-hands", "wave-left-hand", "wave-right-hand", "walk-turn-left",
        "walk-turn-right"}},
      {"C", {"raise-up-both-hands", "raise-up-left-hand", "raise-up-right-hand", "walk"}}};
  for (const UnseenSplit& split : splits) {
    if (split.name == name) return split;
  }
  return Error{"no split '" + name + "'; expected A, B or C"};
}

Result<void> judge_unseen(const UnseenSplit& split, const EvaluateOptions& options,
                          const Bench& bench, const std::vector<NamedModel>& models,
                          std::vector<SystemReport>& reports) {
  // Inputs are normalised by the takes of the pairs alone, so these contents leave no trace.
  TrainingData training_data = bench.training;
  std::erase_if(training_data.pairings, [&](const Pairing& pairing) {
    return is_among(split.contents, bench.training.takes[pairing.styled].row.content);
  });
  const QualityTable blind = judge_blind(split, bench, options.seed);
  Result<std::unique_ptr<System>> posture = make_mean_posture(
      "mean posture", {training_data.takes, training_data.pairings, options.styles, options.seed});
  if (!posture) return posture.error();
  Result<CellTable> posture_cells = judge_contents(**posture, bench, split.contents);
  if (!posture_cells) return posture_cells.error();

  std::map<const Recipe*, CellTable> judged;  // A recipe trained once serves all models of it.
  for (size_t s = 0; s < models.size(); ++s) {
    const Recipe* recipe = &models[s].model->recipe();
    if (!judged.contains(recipe)) {
      Result<NamedModel> model = train_system(*recipe, models[s].name, training_data, options);
      if (!model) return Error{"unseen " + split.name + ": " + model.error().message};
      Result<CellTable> cells =
          judge_contents(ModelSystem(model->name, model->model), bench, split.contents);
      if (!cells) return cells.error();
      judged[recipe] = *std::move(cells);
    }
    UnseenReport report;
    report.name = split.name;
    report.mean = mean_quality(judged[recipe]);
    report.by_content = by_content(judged[recipe]);
    for (const std::string& content : split.contents) {
      const auto seen = reports[s].by_content.find(content);
      if (seen != reports[s].by_content.end()) report.seen_by_content.insert(*seen);
    }
    report.blind_by_content = blind;
    report.mean_posture_by_content = by_content(*posture_cells);
    reports[s].unseen.push_back(std::move(report));
  }
  return {};
}

}  // namespace panache
