#include "eval/evaluator.h"

#include <set>

#include "base/parallel.h"
#include "eval/report_numbers.h"

namespace panache {
namespace {

MetricsTable grouped(const StyleContentTable& cells, std::string StyleContent::*key) {
  std::map<std::string, std::vector<const Metrics*>> groups;
  for (const auto& [cell, metrics] : cells) groups[cell.*key].push_back(&metrics);
  MetricsTable table;
  for (const auto& [name, parts] : groups) table[name] = mean_metrics(parts);
  return table;
}

std::vector<std::string> labels_of(const std::vector<Take>& takes, std::string ManifestRow::*key) {
  std::vector<std::string> labels;
  labels.reserve(takes.size());
  for (const Take& take : takes) labels.push_back(take.row.*key);
  return labels;
}

}  // namespace

MetricsTable by_content(const StyleContentTable& cells) {
  return grouped(cells, &StyleContent::second);
}
MetricsTable by_style(const StyleContentTable& cells) {
  return grouped(cells, &StyleContent::first);
}

Evaluator Evaluator::create(const std::vector<Take>& training, std::vector<Take> test,
                            uint64_t seed) {
  std::set<std::string> styles, contents;
  for (const Take& take : test) {
    styles.insert(take.row.style);
    contents.insert(take.row.content);
  }
  // The classes are the names that some training take has for both style and content.
  std::vector<Take> known;
  for (const Take& take : training) {
    if (styles.contains(take.row.style) && contents.contains(take.row.content)) {
      known.push_back(take);
    }
  }
  std::vector<std::optional<Classifier>> made(2);
  parallel_for(2, [&](int i) {
    const auto key = i == 0 ? &ManifestRow::style : &ManifestRow::content;
    const std::set<std::string>& names = i == 0 ? styles : contents;
    made[i].emplace(known, labels_of(known, key),
                    std::vector<std::string>(names.begin(), names.end()), seed + i);
  });
  return {*std::move(made[0]), *std::move(made[1]), std::move(test)};
}

Evaluator::Evaluator(Classifier styles, Classifier contents, std::vector<Take> test)
    : styles_(std::move(styles)), contents_(std::move(contents)), test_(std::move(test)) {
  std::erase_if(test_, [](const Take& take) { return take.row.neutral; });
  Verdicts all_scores(test_.size());
  parallel_for(static_cast<int>(test_.size()),
               [&](int i) { all_scores[i] = look({.take = &test_[i]}); });
  for (size_t i = 0; i < test_.size(); ++i) {
    references_[{test_[i].row.style, test_[i].row.content}].push_back(std::move(all_scores[i]));
  }
  for (const auto& [cell, members] : references_) {
    real_[cell] = summarise(members, members, std::nullopt);
  }
}

Evaluator::TakeScores Evaluator::look(TakeEvidence of) const {
  const ManifestRow& row = of.take->row;
  const Classification style = styles_.classify(*of.take), content = contents_.classify(*of.take);
  const auto count = [](const Classification& classified, int wanted) {
    return classified.probabilities.argmax(1).eq(wanted).sum().item<double>();
  };
  const int asked = styles_.find(row.style);
  of.windows = static_cast<size_t>(style.probabilities.size(0));
  of.style_windows = count(style, asked);
  of.content_windows = count(content, contents_.find(row.content));
  if (asked >= 0) of.style_probability = style.probabilities.select(1, asked).sum().item<double>();
  TakeScores scores{of.windows, {}, content.features};
  for (const Measure& measure : measures()) {
    scores.values.push_back(measure.of_take ? measure.of_take(of) : kNotMeasured);
  }
  return scores;
}

Metrics Evaluator::summarise(const Verdicts& all_scores, const Verdicts& real,
                             const std::optional<PoseError>& aligned) {
  const auto features = [](const Verdicts& of) {
    std::vector<torch::Tensor> rows;
    for (const TakeScores& scores : of) rows.push_back(scores.features);
    return torch::cat(rows);
  };
  const auto values = [](const Verdicts& of, size_t measure) {
    std::vector<double> found;
    for (const TakeScores& scores : of) found.push_back(scores.values[measure]);
    return found;
  };
  Metrics metrics;
  metrics.takes = all_scores.size();
  for (const TakeScores& scores : all_scores) metrics.windows += scores.windows;
  CellEvidence cell;
  cell.windows = metrics.windows;
  cell.feature_distance = frechet_distance(features(all_scores), features(real));
  cell.aligned = aligned;
  for (size_t m = 0; m < measures().size(); ++m) {
    cell.values = values(all_scores, m);
    cell.real = values(real, m);
    metrics[measures()[m].key] = measures()[m].of_cell(cell);
  }
  return metrics;
}

StyleContentTable Evaluator::evaluate(const std::vector<StyledTake>& outputs,
                                      const std::vector<Take>& inputs,
                                      const PoseErrors& aligned) const {
  Verdicts all_scores(outputs.size());
  parallel_for(static_cast<int>(outputs.size()), [&](int i) {
    const StyledTake& output = outputs[i];
    if (!references_.contains({output.take.row.style, output.take.row.content})) return;
    all_scores[i] = look({&output.take, &inputs[output.input], &output.source_frames});
  });
  std::map<StyleContent, Verdicts> cells;
  for (size_t i = 0; i < outputs.size(); ++i) {
    const ManifestRow& row = outputs[i].take.row;
    if (references_.contains({row.style, row.content})) {
      cells[{row.style, row.content}].push_back(std::move(all_scores[i]));
    }
  }
  StyleContentTable table;
  for (const auto& [cell, members] : cells) {
    const auto error = aligned.find(cell);
    table[cell] = summarise(members, references_.at(cell),
                            error == aligned.end() ? std::nullopt : std::optional(error->second));
  }
  return table;
}

}  // namespace panache
