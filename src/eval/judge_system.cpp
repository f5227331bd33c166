#include <algorithm>
#include <cmath>
#include <ctime>
#include <optional>

#include "base/parallel.h"
#include "base/progress.h"
#include "eval/evaluate.h"
#include "eval/motion_metrics.h"
#include "style/stylizer.h"

namespace panache {
namespace {

constexpr double kStrengths[] = {0, 0.25, 0.5, 0.75, 1, 1.25, 1.5, 1.75, 2};
constexpr double kHalf = 0.5, kMixShares[] = {0, 0.25, kHalf, 0.75, 1};

std::string number(double value) {
  char text[16];
  std::snprintf(text, sizeof text, "%g", value);
  return text;
}

// One request for one input.
struct Job {
  int input;
  Request request;
};

struct Run {
  std::vector<Output> outputs;
  double bone_length_error = 0;  // Metres.
};
Result<Run> run_jobs(const std::shared_ptr<const Model>& model,
                     const std::vector<TestInput>& inputs, const std::vector<Job>& jobs,
                     bool timing = true) {
  std::vector<std::optional<Result<Played>>> played(jobs.size());
  parallel_for(static_cast<int>(jobs.size()), [&](int i) {
    played[i] = run_system(model, inputs, jobs[i].input, jobs[i].request, timing);
  });
  Run run;
  for (std::optional<Result<Played>>& one : played) {
    if (!*one) return one->error();
    run.bone_length_error = std::max(run.bone_length_error, (*one)->bone_length_error);
    run.outputs.push_back(std::move((**one).output));
  }
  return run;
}

// Styles that are judged and that the model knows.
std::vector<std::string> common_styles(const Model& model, const Bench& bench) {
  std::vector<std::string> common;
  for (const std::string& style : bench.styles) {
    if (model.find_style(style).ok()) common.push_back(style);
  }
  return common;
}

// Whether a real test take of the input's own set shows the style: every set has its own neutral.
bool is_shown(const std::string& style, const TestInput& input, const Bench& bench) {
  return std::any_of(bench.judge.test().begin(), bench.judge.test().end(), [&](const Take& take) {
    return take.row.style == style && take.row.set == input.take.row.set;
  });
}

std::vector<Job> jobs_at(const std::vector<std::string>& styles, double strength,
                         const Bench& bench, const std::vector<std::string>& contents) {
  std::vector<Job> jobs;
  for (size_t i = 0; i < bench.inputs.size(); ++i) {
    const std::string& content = bench.inputs[i].take.row.content;
    if (!contents.empty() &&
        std::find(contents.begin(), contents.end(), content) == contents.end()) {
      continue;
    }
    for (const std::string& style : styles) {
      if (!is_shown(style, bench.inputs[i], bench)) continue;
      jobs.push_back({static_cast<int>(i), {style, {{style, static_cast<float>(strength)}}}});
    }
  }
  return jobs;
}

// Judges outputs and adds the pose errors, which come from the networks alone.
CellTable judge_outputs(const NamedModel& system, const Bench& bench,
                        const std::vector<Output>& outputs, const std::vector<Take>& takes,
                        double strength) {
  CellTable cells = bench.judge.judge(outputs, takes);
  add_pose_errors(bench.aligned.errors(*system.model, strength), cells);
  return cells;
}

Result<MixReport> judge_mix(const NamedModel& system, const Bench& bench, const std::string& first,
                            const std::string& second) {
  MixReport mix{first, second, 0, 0, 0};
  const Classifier& styles = bench.judge.styles();
  const Classifier& contents = bench.judge.contents();
  const int from = styles.find(first), to = styles.find(second);
  std::vector<double> shares, leans;
  for (const double share : kMixShares) {
    std::vector<Job> jobs;
    for (size_t i = 0; i < bench.inputs.size(); ++i) {
      jobs.push_back(
          {static_cast<int>(i),
           {first, {{first, static_cast<float>(1 - share)}, {second, static_cast<float>(share)}}}});
    }
    Result<Run> run = run_jobs(system.model, bench.inputs, jobs);
    if (!run) return run.error();
    double windows = 0, lean = 0, either = 0, kept = 0;
    for (const Output& output : run->outputs) {
      const torch::Tensor p = styles.judge(output.take).probabilities;
      const torch::Tensor best = p.argmax(1);
      windows += static_cast<double>(p.size(0));
      lean += (p.select(1, to) - p.select(1, from)).sum().item<double>();
      either += (best.eq(from) | best.eq(to)).sum().item<double>();
      if (share != kHalf) continue;
      const torch::Tensor content = contents.judge(output.take).probabilities.argmax(1);
      kept += content.eq(contents.find(output.take.row.content)).sum().item<double>();
    }
    shares.push_back(share);
    leans.push_back(lean / windows);
    if (share != kHalf) continue;
    mix.either = either / windows;
    mix.content = kept / windows;
  }
  mix.correlation = rank_correlation(shares, leans);
  return mix;
}

// Processor time of one step of one character, in microseconds.
double step_time(const NamedModel& system, const TestInput& input) {
  Result<Stylizer> stylizer = Stylizer::create(system.model, input.rig);
  if (!stylizer) return kNotMeasured;
  std::vector<float> strengths(system.model->styles().size());
  strengths.front() = 1;
  std::vector<Quat> rotations(input.clip.joints());
  std::vector<Vec3> translations(input.clip.joints());
  constexpr int kSteps = 3000;
  const std::clock_t begin = std::clock();
  for (int i = 0; i < kSteps; ++i) {
    stylizer->step(input.clip.pose(i % input.clip.frames), strengths, input.clip.frame_time,
                   {rotations, translations});
  }
  return 1e6 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC / kSteps;
}

// CC: each styled test take asked for its own style again, frame by frame; how far it moves.
Result<double> own_style_distance(const NamedModel& system, const Bench& bench) {
  std::vector<Job> jobs;
  for (size_t i = 0; i < bench.styled.size(); ++i) {
    const std::string& style = bench.styled[i].take.row.style;
    if (system.model->find_style(style).ok()) {
      jobs.push_back({static_cast<int>(i), {style, {{style, 1.0f}}}});
    }
  }
  Result<Run> run = run_jobs(system.model, bench.styled, jobs, false);
  if (!run) return run.error();
  double sum = 0;
  for (const Output& output : run->outputs) {
    sum += summed_distance(output.take, bench.styled[output.input].take);
  }
  return sum / static_cast<double>(std::max<size_t>(1, jobs.size())) * bench.units_per_metre;
}

}  // namespace

void add_pose_errors(const PoseErrors& errors, CellTable& cells) {
  for (const auto& [cell, error] : errors) {
    const auto found = cells.find(cell);
    if (found == cells.end()) continue;
    found->second.pose_error_deg = error.degrees;
    found->second.pose_error_cm = error.cm;
  }
}

Result<CellTable> judge_contents(const NamedModel& system, const Bench& bench,
                                 const std::vector<std::string>& contents) {
  const std::vector<std::string> styles = common_styles(*system.model, bench);
  Result<Run> run = run_jobs(system.model, bench.inputs, jobs_at(styles, 1, bench, contents));
  if (!run) return run.error();
  return judge_outputs(system, bench, run->outputs, takes_of(bench.inputs), 1);
}

Result<SystemReport> judge_system(const NamedModel& system, const Bench& bench) {
  SystemReport report;
  report.name = system.name;
  report.recipe = system.model->recipe().name;
  report.parameters = system.model->parameter_count();
  const std::vector<std::string> styles = common_styles(*system.model, bench);
  if (styles.empty()) {
    return Error{system.name + ": knows none of the styles that the test takes show; it has '" +
                 system.model->styles().front().name + "', they show '" + bench.styles.front() +
                 "'; rename them with --styles"};
  }
  const std::vector<Take> takes = takes_of(bench.inputs);
  std::map<std::string, std::vector<double>> probability, distance;  // Per style, over strengths.
  Progress progress("judging " + system.name);
  for (const double strength : kStrengths) {
    progress.update(strength / 3);
    Result<Run> run = run_jobs(system.model, bench.inputs, jobs_at(styles, strength, bench, {}));
    if (!run) return run.error();
    report.bone_length_error_cm =
        std::max(std::isnan(report.bone_length_error_cm) ? 0.0 : report.bone_length_error_cm,
                 100 * run->bone_length_error);
    const CellTable cells = judge_outputs(system, bench, run->outputs, takes, strength);
    report.strength.push_back({number(strength), mean_quality(cells)});
    for (const auto& [style, quality] : by_style(cells)) {
      probability[style].push_back(quality.style_probability);
      distance[style].push_back(quality.distance_cm);
    }
    if (strength != 1) continue;
    report.seen = mean_quality(cells);
    report.by_content = by_content(cells);
    report.by_style = by_style(cells);
    std::vector<Take> outputs;
    for (const Output& output : run->outputs) outputs.push_back(output.take);
    report.sc =
        distance_to_real(outputs, bench.training.takes, bench.judge.test()) * bench.units_per_metre;
  }
  report.slider_style = report.slider_distance = 0;
  for (const std::string& style : styles) {
    const std::vector<double> strengths(std::begin(kStrengths), std::end(kStrengths));
    const auto until_one = [](std::vector<double> v) {
      v.resize(5);
      return v;
    };
    const double count = static_cast<double>(styles.size());
    report.slider_style +=
        rank_correlation(until_one(strengths), until_one(probability[style])) / count;
    report.slider_distance += rank_correlation(strengths, distance[style]) / count;
  }
  for (size_t a = 0; a < styles.size(); ++a) {
    for (size_t b = a + 1; b < styles.size(); ++b) {
      progress.update(0.67 + 0.33 * static_cast<double>(a) / static_cast<double>(styles.size()));
      Result<MixReport> mix = judge_mix(system, bench, styles[a], styles[b]);
      if (!mix) return mix.error();
      report.mixes.push_back(*mix);
    }
  }
  Result<double> cc = own_style_distance(system, bench);
  if (!cc) return cc.error();
  report.cc = *cc;
  report.step_us = step_time(system, bench.inputs.front());
  return report;
}

}  // namespace panache
