#include "eval/learning.h"

#include <memory>
#include <tuple>

#include "base/progress.h"
#include "learn/learn_style.h"
#include "learn/samples.h"
#include "learn/style_file.h"
#include "learn/take.h"
#include "rig/canonical_body.h"
#include "style/networks/networks.h"

namespace panache {
namespace {

constexpr const char* kModel = "the model";
constexpr const char* kStyle = "learnt here";

// The takes of a style and an action, and the neutral ones: [styled, neutral].
struct Cell {
  std::vector<Take> styled, neutral;
};

// The two takes, synchronised.
struct Test {
  std::vector<Take> takes;
  std::vector<Pairing> pairings;
};

Test lay_together(const Cell& cell) {
  Test test;
  std::vector<int> styled, neutral;
  for (const Take& take : cell.styled) {
    styled.push_back(static_cast<int>(test.takes.size()));
    test.takes.push_back(take);
    test.takes.back().row.style = kStyle;
  }
  for (const Take& take : cell.neutral) {
    neutral.push_back(static_cast<int>(test.takes.size()));
    test.takes.push_back(take);
  }
  test.pairings = pair_takes(test.takes, styled, neutral);
  return test;
}

Result<std::shared_ptr<const Model>> learn(const TensorFile& model, const LearnPair& pair) {
  Result<LearntStyle> learnt = learn_style(model, kModel, {&pair, 1}, kStyle, "");
  if (!learnt) return located(pair.styled_name, learnt.error());
  Result<TensorFile> with = add_style(model, kModel, learnt->file, kStyle, true);
  if (!with) return with.error();
  return Model::create(*with, kModel);
}

double error_of(const std::shared_ptr<const Model>& model, const Test& test, const SampleSet& set) {
  StyleNetworks networks(model);
  std::vector<float> strengths(model->styles().size()), window(set.inputs());
  strengths[static_cast<size_t>(*model->find_style(kStyle))] = 1;
  networks.set_strengths(strengths);
  double sum = 0;
  for (size_t i = 0; i < set.samples().size(); ++i) {
    const Sample& sample = set.samples()[i];
    set.window(i, window);
    networks.forward(window);
    const Take& neutral = test.takes[sample.take];
    const StyleDelta change = model->recipe().to_change(
        networks.pose(), body_at(neutral, sample.frame), root_at(neutral, sample.frame));
    sum += pose_error(test.takes[sample.styled], sample.styled_frame, neutral, sample.frame, change)
               .cm;
  }
  return sum / static_cast<double>(set.samples().size());
}

double error_of(const StyleDelta& change, const Test& test, const SampleSet& set) {
  double sum = 0;
  for (const Sample& sample : set.samples()) {
    sum += pose_error(test.takes[sample.styled], sample.styled_frame, test.takes[sample.take],
                      sample.frame, change)
               .cm;
  }
  return sum / static_cast<double>(set.samples().size());
}

// The same motion as from a clip without its own rotations.
Take without_twist(Take take) {
  for (int f = 0; f < take.frames(); ++f) canonical_frames(take.body[f], 0, take.rotations[f]);
  return take;
}

}  // namespace

Result<std::map<std::string, LearningErrors>> measure_learning(const TensorFile& model,
                                                               const NeutralBank& bank,
                                                               const std::vector<Take>& takes) {
  const Result<std::shared_ptr<const Model>> base = Model::create(model, kModel);
  if (!base) return base.error();
  const Recipe& recipe = (*base)->recipe();
  std::map<std::tuple<int, std::string, std::string>, Cell> cells[2];  // Training, test.
  for (const Take& take : takes) {
    const ManifestRow& row = take.row;
    if (!row.neutral) cells[row.test][{row.set, row.content, row.style}].styled.push_back(take);
  }
  for (const Take& take : takes) {
    if (!take.row.neutral) continue;
    for (auto& [key, cell] : cells[take.row.test]) {
      const auto& [set, content, style] = key;
      if (set == take.row.set && content == take.row.content) cell.neutral.push_back(take);
    }
  }
  std::map<std::string, LearningErrors> found;
  for (const auto& [key, cell] : cells[0]) {
    if (cell.neutral.empty()) continue;
    const auto at = cells[1].find(key);
    const bool is_other = at != cells[1].end() && !at->second.neutral.empty();
    const Test train = lay_together({{cell.styled.front()}, {cell.neutral.front()}});
    const Test test = is_other ? lay_together(at->second) : train;
    const SampleSet seen(train.takes, train.pairings, {kStyle}, recipe, false);
    const SampleSet set(test.takes, test.pairings, {kStyle}, recipe, false);
    if (seen.samples().empty() || set.samples().empty()) continue;
    std::array<float, StyleDelta::kSize> mean{};
    for (size_t i = 0; i < seen.samples().size(); ++i) {
      for (size_t n = 0; n < mean.size(); ++n) {
        mean[n] += seen.target(i)[n] / static_cast<float>(seen.samples().size());
      }
    }
    const Take& styled = cell.styled.front();
    LearnPair pair{"neutral", styled.row.path, cell.neutral.front(), styled};
    const Result<std::shared_ptr<const Model>> with = learn(model, pair);
    if (!with) continue;  // The pair is not of one action.
    const Stopwatch watch;
    NeutralTwin twin = bank.twin(styled);
    pair.neutral = std::move(twin.take);
    pair.styled = without_twist(styled);
    pair.twin = twin.facts;
    const Result<std::shared_ptr<const Model>> without = learn(model, pair);
    if (!without) return without.error();
    const double seconds = watch.seconds();
    const auto& [number, content, style] = key;
    LearningErrors& errors = found[content + (is_other ? "" : ", same take")];
    ++errors.styles;
    errors.none += error_of(StyleDelta{}, test, set);
    errors.posture += error_of(unpack(mean), test, set);
    errors.pair += error_of(*with, test, set);
    errors.alone += error_of(*without, test, set);
    errors.seconds += seconds;
    errors.certainty += twin.facts.certainty;
    errors.people += twin.facts.people;
    errors.known += twin.facts.is_known;
  }
  for (auto& [content, errors] : found) {
    for (double* sum : {&errors.none, &errors.posture, &errors.pair, &errors.alone, &errors.seconds,
                        &errors.certainty, &errors.people, &errors.known}) {
      *sum /= errors.styles;
    }
  }
  return found;
}

}  // namespace panache
