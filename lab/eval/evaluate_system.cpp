#include <algorithm>
#include <cmath>
#include <optional>

#include "base/parallel.h"
#include "base/progress.h"
#include "eval/evaluate.h"
#include "eval/motion_metrics.h"
#include "eval/report_numbers.h"

namespace panache {
namespace {

constexpr double kHalf = 0.5, kMixShares[] = {0, 0.25, kHalf, 0.75, 1};

std::string number(double value) {
  char text[16];
  std::snprintf(text, sizeof text, "%g", value);
  return text;
}

// One request for one input.
struct Job {
  int input;
  StyleRequest request;
};

struct Run {
  std::vector<StyledTake> outputs;
  double bone_length_error = 0;  // Metres.
};
Result<Run> run_jobs(const System& system, const std::vector<TestInput>& inputs,
                     const std::vector<Job>& jobs) {
  auto results = parallel_results<RunResult>(
      jobs.size(), [&](int i) { return system.run(inputs[jobs[i].input], jobs[i].request); });
  if (!results) return results.error();
  Run run;
  for (size_t i = 0; i < jobs.size(); ++i) {
    RunResult& one = (*results)[i];
    run.bone_length_error = std::max(run.bone_length_error, one.bone_length_error);
    run.outputs.push_back(std::move(one.output));
    run.outputs.back().input = jobs[i].input;
  }
  return run;
}

// The evaluated styles that the system has.
std::vector<std::string> common_styles(const System& system, const TestSet& test_set) {
  const std::vector<std::string> known = system.styles();
  std::vector<std::string> common;
  for (const std::string& style : test_set.styles) {
    if (std::find(known.begin(), known.end(), style) != known.end()) common.push_back(style);
  }
  return common;
}

std::vector<Job> jobs_at(const System& system, const std::vector<std::string>& styles,
                         double strength, const TestSet& test_set,
                         const std::vector<std::string>& contents) {
  std::vector<Job> jobs;
  for (size_t i = 0; i < test_set.inputs.size(); ++i) {
    const std::string& content = test_set.inputs[i].take.row.content;
    if (!contents.empty() &&
        std::find(contents.begin(), contents.end(), content) == contents.end()) {
      continue;
    }
    for (const std::string& style : styles) {
      if (!test_set.is_shown(style, test_set.inputs[i].take.row.set)) continue;
      const StyleRequest request{style, {{style, static_cast<float>(strength)}}};
      if (system.can_run(test_set.inputs[i], request))
        jobs.push_back({static_cast<int>(i), request});
    }
  }
  return jobs;
}

// Applies every style known to another performer's classifier to this performer's neutral motion.
std::vector<Job> jobs_across(const System& system, const std::vector<std::string>& styles,
                             const TestSet& test_set) {
  std::vector<Job> jobs;
  for (size_t i = 0; i < test_set.inputs.size(); ++i) {
    for (const std::string& style : styles) {
      ManifestRow row = test_set.inputs[i].take.row;
      row.style = style;
      const StyleRequest request{style, {{style, 1.0f}}};
      if (test_set.performers.is_judged_across(row) &&
          system.can_run(test_set.inputs[i], request)) {
        jobs.push_back({static_cast<int>(i), request});
      }
    }
  }
  return jobs;
}

// Uses the neutral motion of the performers who show both styles. Empty if no performer does, or
// if the system cannot mix the two.
Result<std::optional<MixReport>> evaluate_mix(const System& system, const TestSet& test_set,
                                              const std::string& first, const std::string& second) {
  MixReport mix{first, second, 0, 0, 0};
  const Classifier& styles = test_set.evaluator.styles();
  const Classifier& contents = test_set.evaluator.contents();
  const int from = styles.find(first), to = styles.find(second);
  std::vector<double> shares, leans;
  for (const double share : kMixShares) {
    std::vector<Job> jobs;
    for (size_t i = 0; i < test_set.inputs.size(); ++i) {
      const TestInput& input = test_set.inputs[i];
      const int set = input.take.row.set;
      if (!test_set.is_shown(first, set) || !test_set.is_shown(second, set)) continue;
      const StyleRequest request{
          first, {{first, static_cast<float>(1 - share)}, {second, static_cast<float>(share)}}};
      if (system.can_run(test_set.inputs[i], request))
        jobs.push_back({static_cast<int>(i), request});
    }
    if (jobs.empty()) return std::optional<MixReport>();
    Result<Run> run = run_jobs(system, test_set.inputs, jobs);
    if (!run) return run.error();
    double windows = 0, lean = 0, either = 0, kept = 0;
    for (const StyledTake& output : run->outputs) {
      const torch::Tensor p = styles.classify(output.take).probabilities;
      const torch::Tensor best = p.argmax(1);
      windows += static_cast<double>(p.size(0));
      lean += (p.select(1, to) - p.select(1, from)).sum().item<double>();
      either += (best.eq(from) | best.eq(to)).sum().item<double>();
      if (share != kHalf) continue;
      const torch::Tensor content = contents.classify(output.take).probabilities.argmax(1);
      kept += content.eq(contents.find(output.take.row.content)).sum().item<double>();
    }
    shares.push_back(share);
    leans.push_back(lean / windows);
    if (share != kHalf) continue;
    mix.either = either / windows;
    mix.content = kept / windows;
  }
  mix.correlation = rank_correlation(shares, leans);
  return std::optional(mix);
}

// CC: requests each styled test take in its own style again, frame by frame; the mean displacement.
Result<double> own_style_distance(const System& system, const TestSet& test_set) {
  std::vector<Job> jobs;
  for (size_t i = 0; i < test_set.styled.size(); ++i) {
    const std::string& style = test_set.styled[i].take.row.style;
    const StyleRequest request{style, {{style, 1.0f}}, false};
    if (system.can_run(test_set.styled[i], request)) jobs.push_back({static_cast<int>(i), request});
  }
  if (jobs.empty()) return kNotMeasured;
  Result<Run> run = run_jobs(system, test_set.styled, jobs);
  if (!run) return run.error();
  double sum = 0;
  for (const StyledTake& output : run->outputs) {
    sum += summed_distance(output.take, test_set.styled[output.input].take);
  }
  return sum / static_cast<double>(jobs.size()) * test_set.units_per_metre;
}

// The effect of the strength over all styles; omitted unless there are values at all strengths.
double mean_correlation(const std::map<std::string, std::vector<double>>& by_style,
                        const std::vector<std::string>& styles, double until) {
  double sum = 0;
  for (const std::string& style : styles) {
    const auto found = by_style.find(style);
    if (found == by_style.end() || found->second.size() != kStrengths.size()) return kNotMeasured;
    std::vector<double> strengths, values;
    for (size_t i = 0; i < kStrengths.size() && kStrengths[i] <= until; ++i) {
      strengths.push_back(kStrengths[i]);
      values.push_back(found->second[i]);
    }
    sum += rank_correlation(strengths, values) / static_cast<double>(styles.size());
  }
  return sum;
}

// At every strength that the system supports.
Result<void> judge_strengths(const System& system, const TestSet& test_set,
                             const std::vector<std::string>& styles, Progress& progress,
                             SystemReport& report) {
  const std::vector<Take> takes = takes_of(test_set.inputs);
  std::map<std::string, std::vector<double>> probability, distance;  // Per style, over strengths.
  for (const double strength : kStrengths) {
    progress.update(strength / 3);
    const std::vector<Job> jobs = jobs_at(system, styles, strength, test_set, {});
    if (jobs.empty()) continue;
    Result<Run> run = run_jobs(system, test_set.inputs, jobs);
    if (!run) return run.error();
    report.bone_length_error_cm =
        std::max(std::isnan(report.bone_length_error_cm) ? 0.0 : report.bone_length_error_cm,
                 100 * run->bone_length_error);
    const StyleContentTable cells =
        test_set.evaluator.evaluate(run->outputs, takes, test_set.aligned.errors(system, strength));
    report.strength.push_back({number(strength), mean_metrics(cells)});
    report.strength_by_style.push_back({number(strength), by_style(cells)});
    for (const auto& [style, metrics] : report.strength_by_style.back().second) {
      probability[style].push_back(metrics["style_probability"]);
      distance[style].push_back(metrics["distance_cm"]);
    }
    if (strength != 1) continue;
    report.seen = mean_metrics(cells);
    report.by_content = by_content(cells);
    report.by_style = by_style(cells);
    const std::vector<Take> outputs = takes_of(run->outputs);
    report.clips = test_set.performers.judge(outputs);
    report.sc = distance_to_real(outputs, test_set.training.takes, test_set.evaluator.test()) *
                test_set.units_per_metre;
  }
  report.slider_style = mean_correlation(probability, styles, 1);
  report.slider_distance = mean_correlation(distance, styles, 2);
  return {};
}

}  // namespace

bool TestSet::is_shown(const std::string& style, int set) const {
  return std::ranges::any_of(evaluator.test(), [&](const Take& take) {
    return take.row.style == style && take.row.set == set;
  });
}

Result<ContentsEvaluation> evaluate_contents(const System& system, const TestSet& test_set,
                                             const std::vector<std::string>& contents) {
  const std::vector<std::string> styles = common_styles(system, test_set);
  Result<Run> run =
      run_jobs(system, test_set.inputs, jobs_at(system, styles, 1, test_set, contents));
  if (!run) return run.error();
  return ContentsEvaluation{test_set.evaluator.evaluate(run->outputs, takes_of(test_set.inputs),
                                                        test_set.aligned.errors(system)),
                            test_set.performers.judge(takes_of(run->outputs))};
}

Result<SystemReport> evaluate_system(const System& system, const TestSet& test_set) {
  SystemReport report;
  report.name = system.name();
  const std::vector<std::string> styles = common_styles(system, test_set);
  if (styles.empty()) {
    const std::string has =
        system.styles().empty() ? "no styles" : "'" + system.styles().front() + "'";
    return Error{system.name() + ": knows none of the styles that the test takes show; it has " +
                 has + ", they show '" + test_set.styles.front() + "'; rename them with --styles"};
  }
  Progress progress("judging " + system.name());
  if (Result<void> done = judge_strengths(system, test_set, styles, progress, report); !done) {
    return done.error();
  }
  Result<Run> across = run_jobs(system, test_set.inputs, jobs_across(system, styles, test_set));
  if (!across) return across.error();
  report.clips_across = test_set.performers.judge_across(takes_of(across->outputs));
  for (size_t a = 0; a < styles.size(); ++a) {
    for (size_t b = a + 1; b < styles.size(); ++b) {
      progress.update(0.67 + 0.33 * static_cast<double>(a) / static_cast<double>(styles.size()));
      Result<std::optional<MixReport>> mix = evaluate_mix(system, test_set, styles[a], styles[b]);
      if (!mix) return mix.error();
      if (*mix) report.mixes.push_back(**mix);
    }
  }
  Result<double> cc = own_style_distance(system, test_set);
  if (!cc) return cc.error();
  report.cc = *cc;
  report.step_us = system.step_us(test_set.inputs.front());
  return report;
}

}  // namespace panache
