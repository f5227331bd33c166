#include "eval/judge.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "base/parallel.h"
#include "eval/frechet.h"

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
  for (const Measure& measure : measures()) {
    Mean value;
    for (const Quality* part : parts) value.add((*part)[measure.key]);
    mean[measure.key] = value.value();
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
       {std::tuple{"style", real["style_accuracy"], floor.style},
        std::tuple{"content", real["content_accuracy"], floor.content}}) {
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
  Verdicts verdicts(test_.size());
  parallel_for(static_cast<int>(test_.size()),
               [&](int i) { verdicts[i] = look({.take = &test_[i]}); });
  for (size_t i = 0; i < test_.size(); ++i) {
    references_[{test_[i].row.style, test_[i].row.content}].push_back(std::move(verdicts[i]));
  }
  for (const auto& [cell, members] : references_) {
    real_[cell] = summarise(members, members, std::nullopt);
  }
}

Judge::Verdict Judge::look(TakeEvidence of) const {
  const ManifestRow& row = of.take->row;
  const Judged style = styles_.judge(*of.take), content = contents_.judge(*of.take);
  const auto count = [](const Judged& judged, int wanted) {
    return judged.probabilities.argmax(1).eq(wanted).sum().item<double>();
  };
  const int asked = styles_.find(row.style);
  of.windows = static_cast<size_t>(style.probabilities.size(0));
  of.style_windows = count(style, asked);
  of.content_windows = count(content, contents_.find(row.content));
  if (asked >= 0) of.style_probability = style.probabilities.select(1, asked).sum().item<double>();
  Verdict verdict{of.windows, {}, content.features};
  for (const Measure& measure : measures()) {
    verdict.values.push_back(measure.of_take ? measure.of_take(of) : kNotMeasured);
  }
  return verdict;
}

Quality Judge::summarise(const Verdicts& verdicts, const Verdicts& real,
                         const std::optional<PoseError>& aligned) {
  const auto features = [](const Verdicts& of) {
    std::vector<torch::Tensor> rows;
    for (const Verdict& verdict : of) rows.push_back(verdict.features);
    return torch::cat(rows);
  };
  const auto values = [](const Verdicts& of, size_t measure) {
    std::vector<double> found;
    for (const Verdict& verdict : of) found.push_back(verdict.values[measure]);
    return found;
  };
  Quality quality;
  quality.takes = verdicts.size();
  for (const Verdict& verdict : verdicts) quality.windows += verdict.windows;
  CellEvidence cell;
  cell.windows = quality.windows;
  cell.feature_distance = frechet_distance(features(verdicts), features(real));
  cell.aligned = aligned;
  for (size_t m = 0; m < measures().size(); ++m) {
    cell.values = values(verdicts, m);
    cell.real = values(real, m);
    quality[measures()[m].key] = measures()[m].of_cell(cell);
  }
  return quality;
}

CellTable Judge::judge(const std::vector<Output>& outputs, const std::vector<Take>& inputs,
                       const PoseErrors& aligned) const {
  Verdicts verdicts(outputs.size());
  parallel_for(static_cast<int>(outputs.size()), [&](int i) {
    const Output& output = outputs[i];
    if (!references_.contains({output.take.row.style, output.take.row.content})) return;
    verdicts[i] = look({&output.take, &inputs[output.input], &output.source_frames});
  });
  std::map<Cell, Verdicts> cells;
  for (size_t i = 0; i < outputs.size(); ++i) {
    const ManifestRow& row = outputs[i].take.row;
    if (references_.contains({row.style, row.content})) {
      cells[{row.style, row.content}].push_back(std::move(verdicts[i]));
    }
  }
  CellTable table;
  for (const auto& [cell, members] : cells) {
    const auto error = aligned.find(cell);
    table[cell] = summarise(members, references_.at(cell),
                            error == aligned.end() ? std::nullopt : std::optional(error->second));
  }
  return table;
}

}  // namespace panache
