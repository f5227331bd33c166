#include "eval/judge.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "base/parallel.h"
#include "eval/frechet.h"
#include "eval/motion_metrics.h"

namespace panache {
namespace {

// Mean of numbers, those not measured left out.
class Mean {
 public:
  void add(double value) {
    if (std::isnan(value)) return;
    sum_ += value;
    ++count_;
  }
  double value() const { return count_ > 0 ? sum_ / count_ : kNotMeasured; }

 private:
  double sum_ = 0;
  int count_ = 0;
};

Quality mean_of(const std::vector<const Quality*>& parts) {
  Quality mean;
  for (const QualityField& field : kQualityFields) {
    Mean value;
    for (const Quality* part : parts) value.add(part->*field.value);
    mean.*field.value = value.value();
  }
  for (const Quality* part : parts) {
    mean.takes += part->takes;
    mean.windows += part->windows;
  }
  return mean;
}

QualityTable grouped(const CellTable& cells, std::string Cell::*key) {
  std::map<std::string, std::vector<const Quality*>> groups;
  for (const auto& [cell, quality] : cells) groups[cell.*key].push_back(&quality);
  QualityTable table;
  for (const auto& [name, parts] : groups) table[name] = mean_of(parts);
  return table;
}

std::vector<std::string> labels_of(const std::vector<Take>& takes, std::string ManifestRow::*key) {
  std::vector<std::string> labels;
  for (const Take& take : takes) labels.push_back(take.row.*key);
  return labels;
}

std::string percent(double share) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3f", share);
  return text;
}

}  // namespace

Quality mean_quality(const CellTable& cells) {
  std::vector<const Quality*> parts;
  for (const auto& [cell, quality] : cells) parts.push_back(&quality);
  return mean_of(parts);
}
QualityTable by_content(const CellTable& cells) { return grouped(cells, &Cell::second); }
QualityTable by_style(const CellTable& cells) { return grouped(cells, &Cell::first); }

CellTable of_contents(const CellTable& cells, const std::vector<std::string>& contents) {
  CellTable some;
  for (const auto& [cell, quality] : cells) {
    if (std::find(contents.begin(), contents.end(), cell.second) != contents.end()) {
      some[cell] = quality;
    }
  }
  return some;
}

Result<Judge> Judge::create(const std::vector<Take>& training, std::vector<Take> test,
                            const JudgeFloor& floor, uint64_t seed) {
  std::set<std::string> styles, contents;
  for (const Take& take : test) {
    styles.insert(take.row.style);
    contents.insert(take.row.content);
  }
  // A class is what a training take has both names of.
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
  Judge judge(*std::move(made[0]), *std::move(made[1]), std::move(test));
  const Quality real = mean_quality(judge.real_);
  for (const auto& [what, share, least] :
       {std::tuple{"style", real.style_accuracy, floor.style},
        std::tuple{"content", real.content_accuracy, floor.content}}) {
    if (!(share >= least)) {
      return Error{std::string("the ") + what + " classifier recognises " + percent(share) +
                   " of the windows of real test takes; expected at least " + percent(least) +
                   ", so its word on other motion would mean nothing; give more training takes of "
                   "the test takes' styles and contents"};
    }
  }
  return judge;
}

Judge::Judge(Classifier styles, Classifier contents, std::vector<Take> test)
    : styles_(std::move(styles)), contents_(std::move(contents)), test_(std::move(test)) {
  std::erase_if(test_, [](const Take& take) { return take.row.neutral; });
  std::vector<Verdict> verdicts(test_.size());
  parallel_for(static_cast<int>(test_.size()), [&](int i) { verdicts[i] = look(test_[i]); });
  std::map<Cell, std::vector<const Verdict*>> cells;
  for (size_t i = 0; i < test_.size(); ++i) {
    cells[{test_[i].row.style, test_[i].row.content}].push_back(&verdicts[i]);
  }
  for (const auto& [cell, members] : cells) {
    references_[cell] = refer(members);
    real_[cell] = summarise(members, references_[cell]);
  }
}

Judge::Verdict Judge::look(const Take& take) const {
  const Judged style = styles_.judge(take), content = contents_.judge(take);
  Verdict verdict;
  verdict.windows = static_cast<size_t>(style.probabilities.size(0));
  const auto count = [](const Judged& judged, int wanted) {
    return judged.probabilities.argmax(1).eq(wanted).sum().item<double>();
  };
  const int asked = styles_.find(take.row.style);
  verdict.style = count(style, asked);
  verdict.content = count(content, contents_.find(take.row.content));
  if (asked >= 0) verdict.probability = style.probabilities.select(1, asked).sum().item<double>();
  verdict.features = content.features;
  verdict.jerk = mean_jerk(take);
  verdict.skating = skating_ratio(take);
  verdict.slide = 100 * weighted_skating(take);
  verdict.cadence = cadence(take);
  return verdict;
}

Judge::Reference Judge::refer(const std::vector<const Verdict*>& verdicts) {
  Mean jerk, cadence_mean;
  std::vector<torch::Tensor> features;
  for (const Verdict* verdict : verdicts) {
    jerk.add(verdict->jerk);
    cadence_mean.add(verdict->cadence);
    features.push_back(verdict->features);
  }
  return {jerk.value(), cadence_mean.value(), torch::cat(features)};
}

Quality Judge::summarise(const std::vector<const Verdict*>& verdicts,
                         const Reference& reference) const {
  Quality quality;
  double style = 0, content = 0, probability = 0;
  Mean jerk, skating, slide, steps, distance;
  std::vector<torch::Tensor> features;
  for (const Verdict* verdict : verdicts) {
    ++quality.takes;
    quality.windows += verdict->windows;
    style += verdict->style;
    content += verdict->content;
    probability += verdict->probability;
    jerk.add(verdict->jerk);
    skating.add(verdict->skating);
    slide.add(verdict->slide);
    steps.add(verdict->cadence);
    distance.add(verdict->distance);
    features.push_back(verdict->features);
  }
  const double windows = static_cast<double>(quality.windows);
  quality.style_accuracy = style / windows;
  quality.content_accuracy = content / windows;
  quality.style_probability = probability / windows;
  quality.jerk_ratio = jerk.value() / reference.jerk;
  quality.skating_ratio = skating.value();
  quality.skating_cm_s = slide.value();
  quality.fmd = frechet_distance(torch::cat(features), reference.features);
  quality.cadence_ratio = steps.value() / reference.cadence;
  quality.distance_cm = distance.value();
  return quality;
}

CellTable Judge::judge(const std::vector<Output>& outputs, const std::vector<Take>& inputs) const {
  std::vector<Verdict> verdicts(outputs.size());
  parallel_for(static_cast<int>(outputs.size()), [&](int i) {
    const Output& output = outputs[i];
    if (!references_.contains({output.take.row.style, output.take.row.content})) return;
    verdicts[i] = look(output.take);
    verdicts[i].distance =
        100 * mean_distance(output.take, inputs[output.input], output.source_frames);
  });
  std::map<Cell, std::vector<const Verdict*>> cells;
  for (size_t i = 0; i < outputs.size(); ++i) {
    const ManifestRow& row = outputs[i].take.row;
    if (references_.contains({row.style, row.content})) {
      cells[{row.style, row.content}].push_back(&verdicts[i]);
    }
  }
  CellTable table;
  for (const auto& [cell, members] : cells) {
    table[cell] = summarise(members, references_.at(cell));
  }
  return table;
}

}  // namespace panache
