#include "eval/removal.h"

#include <algorithm>

#include "base/parallel.h"
#include "base/progress.h"
#include "eval/evaluate.h"
#include "eval/motion_metrics.h"
#include "eval/ood.h"
#include "eval/report_numbers.h"
#include "eval/system.h"
#include "learn/recognise.h"
#include "style/play/removal.h"

namespace panache {
namespace {

// A clip before and after removal.
struct Change {
  double neutral = kNotMeasured, before = kNotMeasured, content = kNotMeasured;
  double cm = kNotMeasured, cm_before = kNotMeasured, jerk = kNotMeasured, jumps = kNotMeasured;
};

RemovalSummary summarize(const std::vector<Change>& clips) {
  const auto mean = [&](double Change::*value) {
    std::vector<double> values;
    for (const Change& clip : clips) values.push_back(clip.*value);
    return finite_mean(values);
  };
  RemovalSummary out;
  out.clips = clips.size();
  out.neutral = mean(&Change::neutral);
  out.before = mean(&Change::before);
  out.content = mean(&Change::content);
  out.cm = mean(&Change::cm);
  out.cm_ratio = out.cm / mean(&Change::cm_before);
  out.jerk = mean(&Change::jerk);
  out.jumps = mean(&Change::jumps) * static_cast<double>(clips.size());
  return out;
}

double kept(const Classifier& contents, const Take& take) {
  const torch::Tensor best = contents.classify(take).probabilities.argmax(1);
  return best.eq(contents.find(take.row.content)).to(torch::kFloat64).mean().item<double>();
}

Result<Take> remove_from(const TestInput& input, const std::shared_ptr<const Model>& remover,
                         const std::string& style, bool timing) {
  Result<int> found = find_removal(*remover, style);
  if (!found) return found.error();
  RestyleOptions options;
  options.timing = timing;
  Result<Restyled> out =
      restyle_without(input.clip, input.rig, {remover, *found}, remover, {}, options);
  if (!out) return located(input.take.row.path, out.error());
  return styled_result(input, "neutral", *out).output.take;
}

Result<RemovalSummary> remove_own(const std::shared_ptr<const Model>& remover, bool named,
                                  const TestSet& test_set) {
  std::vector<Take> before, after;
  const auto outputs = parallel_results<Take>(test_set.styled.size(), [&](int i) {
    const TestInput& input = test_set.styled[i];
    return remove_from(input, remover, named ? input.take.row.style : "", true);
  });
  if (!outputs) return outputs.error();
  std::vector<Change> clips;
  for (size_t i = 0; i < outputs->size(); ++i) {
    Take input = test_set.styled[i].take, output = (*outputs)[i];
    input.row.style = output.row.style = "neutral";
    // Performers without neutral takes have no classifier for it.
    const auto was = test_set.performers.judge({input}), is = test_set.performers.judge({output});
    if (was.empty() || is.empty()) continue;
    Change& clip = clips.emplace_back();
    clip.neutral = is[0].recognised();
    clip.before = was[0].recognised();
    clip.cm = is[0].cm;
    clip.cm_before = was[0].cm;
    const Classifier& contents = test_set.evaluator.contents();
    const double had = kept(contents, input);
    if (had > 0) clip.content = kept(contents, output) / had;
    clip.jerk = mean_jerk(output) / mean_jerk(input);
  }
  return summarize(clips);
}

bool is_told_neutral(const Discriminant& judge, int64_t neutral, const Take& take) {
  const torch::Tensor best = judge.scores(take).argmax(1);
  return std::get<0>(best.mode()).item<int64_t>() == neutral;
}

Result<void> remove_from_restyled(const std::shared_ptr<const Model>& remover,
                                  const std::shared_ptr<const Model>& model,
                                  const TestSet& test_set, const std::vector<TestInput>& inputs,
                                  RemovalReport& report) {
  std::vector<Take> known = test_set.training.takes;
  known.insert(known.end(), test_set.training.unlabelled.begin(),
               test_set.training.unlabelled.end());
  std::vector<std::string> labels, classes = test_set.styles;
  for (const Take& take : known) labels.push_back(take.row.neutral ? "neutral" : take.row.style);
  classes.push_back("neutral");
  const auto neutral = static_cast<int64_t>(classes.size()) - 1;
  const Discriminant judge(known, labels, classes);
  const size_t styles = model->styles().size();
  std::vector<Change> clips(inputs.size() * styles), originals(inputs.size());
  std::vector<Result<void>> failures(clips.size(), Result<void>());
  parallel_for(static_cast<int>(inputs.size()), [&](int i) {
    originals[i].neutral = is_told_neutral(judge, neutral, inputs[i].take);
  });
  parallel_for(static_cast<int>(clips.size()), [&](int i) {
    const TestInput& input = inputs[i / styles];
    const int style = static_cast<int>(i % styles);
    RestyleOptions options;
    options.timing = false;
    Result<Restyled> made = restyle(input.clip, input.rig, model, {{style, {{0, 1}}}}, options);
    if (!made) return void(failures[i] = made.error());
    TestInput styled{made->clip, input.rig, input.take};
    styled.take = styled_result(input, "neutral", *made).output.take;
    Result<Take> output = remove_from(styled, remover, model->styles()[style].name, false);
    if (!output) return void(failures[i] = output.error());
    const OodRow row = compare_ood(styled.take, *output);
    clips[i].neutral = is_told_neutral(judge, neutral, *output);
    clips[i].before = is_told_neutral(judge, neutral, styled.take);
    clips[i].cm = 100 * summed_distance(*output, input.take) / kHumanJoints;
    clips[i].cm_before = 100 * summed_distance(styled.take, input.take) / kHumanJoints;
    clips[i].jerk = row.jerk_ratio;
    clips[i].jumps = row.jumps;
  });
  for (const Result<void>& failure : failures) {
    if (!failure) return failure.error();
  }
  report.restyled = summarize(clips);
  report.original = summarize(originals);
  return {};
}

Result<RecognitionSummary> recognise(const std::shared_ptr<const Model>& remover,
                                     const std::vector<const Take*>& takes) {
  RecognitionSummary out;
  std::vector<double> first, third, neutral;
  for (const Take* take : takes) {
    Result<std::vector<StyleShare>> shares = recognise_styles(remover, *take);
    if (!shares) return shares.error();
    const auto wanted = std::find_if(shares->begin(), shares->end(), [&](const StyleShare& share) {
      return take->row.neutral
                 ? share.style < 0
                 : share.style >= 0 && remover->styles()[share.style].name == take->row.style;
    });
    const auto rank = wanted - shares->begin();
    if (take->row.neutral) {
      neutral.push_back(rank < 1);
    } else {
      first.push_back(rank < 1);
      third.push_back(rank < 3);
    }
  }
  return RecognitionSummary{first.size(), neutral.size(), finite_mean(first), finite_mean(third),
                            finite_mean(neutral)};
}

}  // namespace

Result<RemovalReport> measure_removal(const std::shared_ptr<const Model>& remover,
                                      const std::shared_ptr<const Model>& model,
                                      const TestSet& test_set,
                                      const std::vector<std::string>& ood) {
  Progress progress("evaluating the remover");
  RemovalReport report;
  for (const bool named : {true, false}) {
    Result<RemovalSummary> own = remove_own(remover, named, test_set);
    if (!own) return own.error();
    (named ? report.named : report.any) = *own;
    progress.update(named ? 0.2 : 0.4);
  }
  std::vector<const Take*> takes;
  for (const std::vector<TestInput>* part : {&test_set.inputs, &test_set.styled}) {
    for (const TestInput& input : *part) takes.push_back(&input.take);
  }
  Result<RecognitionSummary> recognition = recognise(remover, takes);
  if (!recognition) return recognition.error();
  report.recognition = *recognition;
  if (ood.empty()) return report;

  std::vector<ManifestRow> rows;
  for (const std::string& path : ood) {
    rows.emplace_back().path = path;
    rows.back().neutral = true;
  }
  Result<std::vector<TestInput>> inputs = load_inputs(rows);
  if (!inputs) return inputs.error();
  takes.clear();
  for (const TestInput& input : *inputs) takes.push_back(&input.take);
  recognition = recognise(remover, takes);
  if (!recognition) return recognition.error();
  report.others = *recognition;
  if (!model) return report;
  auto done = remove_from_restyled(remover, model, test_set, *inputs, report);
  if (!done) return done.error();
  return report;
}

}  // namespace panache
