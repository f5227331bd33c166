// panache-lab outputs: what the stages after the networks do to any motion.

#include <memory>
#include <string>
#include <vector>

#include "base/progress.h"
#include "eval/ood.h"
#include "eval/report_numbers.h"
#include "eval/report_ood.h"
#include "eval/systems/model_system.h"
#include "lab_verbs.h"
#include "messages.h"

namespace panache::cli {
namespace {

struct OutputsFlags {
  std::string clips, model;
  float strength = 1;
  bool by_clip = false;
};

std::string line(const std::string& name, const std::vector<double>& values, int digits) {
  std::string text = padded(name, 28);
  for (const double value : values) {
    const std::string cell = number_text(value, digits);
    text += std::string(character_count(cell) < 10 ? 10 - character_count(cell) : 1, ' ') + cell;
  }
  return text + "\n";
}

double jumps(const std::vector<OodRow>& rows) {
  double sum = 0;
  for (const OodRow& row : rows) sum += row.jumps;
  return sum;
}

std::string table(const std::vector<std::vector<OodRow>>& groups) {
  std::string text;
  const auto add = [&](const std::string& name, int digits, const auto& value) {
    std::vector<double> values;
    for (const std::vector<OodRow>& rows : groups) values.push_back(value(rows));
    text += line(name, values, digits);
  };
  const auto legs = [&](const char* name, int digits, double LegSummary::*value, double unit) {
    add(name, digits, [&](const auto& rows) { return unit * (summarize_legs(rows).*value); });
  };
  legs("thighs beyond, upright, %", 2, &LegSummary::upright_thighs, 100);
  legs("knees beyond, upright, %", 2, &LegSummary::upright_knees, 100);
  legs("thighs beyond, crouching, %", 2, &LegSummary::crouching_thighs, 100);
  legs("knees beyond, crouching, %", 2, &LegSummary::crouching_knees, 100);
  legs("the worst of them, degrees", 0, &LegSummary::worst_deg, 1);
  const auto mean = [&](const char* name, double OodRow::*value, double unit) {
    add(name, 2, [&](const auto& rows) { return unit * finite_mean(values_of(rows, value)); });
  };
  mean("frames beyond limits, %", &OodRow::beyond_limits, 100);
  mean("frames under the floor, %", &OodRow::under_floor, 100);
  add("frames with a jump", 0, jumps);
  add("jerk of the input's, 90 %", 2,
      [](const auto& rows) { return quantile(values_of(rows, &OodRow::jerk_ratio), 0.9); });
  mean("sliding, % of planted frames", &OodRow::skating_ratio, 100);
  mean("the input's", &OodRow::input_skating_ratio, 100);
  for (size_t m = 0; m < kShotKeys.size(); ++m) {
    add(std::string(kShotKeys[m]) + ", 90 %", 1,
        [&](const auto& rows) { return quantile(shots_of(rows, m), 0.9); });
  }
  return text;
}

int run(const OutputsFlags& options) {
  const std::vector<std::string> files = need(list_ood(options.clips));
  const ModelSystem system("model", need(Model::load(options.model)));
  std::vector<OodRow> rows;
  {
    Progress progress("styling");
    rows = need(measure_ood(
        files, system, nullptr, [&](double done) { progress.update(done); }, options.strength));
  }
  // Constants are chosen on every second clip and checked on the others.
  std::vector<std::vector<OodRow>> halves(2);
  size_t clip = 0;
  for (const auto& [name, of_clip] : ood_by_clip(rows)) {
    std::vector<OodRow>& half = halves[clip++ % 2];
    half.insert(half.end(), of_clip.begin(), of_clip.end());
    if (!options.by_clip) continue;
    const LegSummary legs = summarize_legs(of_clip);
    print(line(name,
               {jumps(of_clip), 100 * legs.upright_thighs, 100 * legs.upright_knees,
                100 * legs.crouching_thighs, 100 * legs.crouching_knees, legs.worst_deg},
               1));
  }
  print(padded(std::to_string(rows.size()) + " outputs", 28) + "    to tune     aside\n" +
        table(halves));
  return kDone;
}

}  // namespace

void add_outputs(CLI::App& app, int& exit_code) {
  CLI::App* verb = app.add_subcommand(
      "outputs", "Measure what the stages after the networks do to any motion, in every style");
  auto options = std::make_shared<OutputsFlags>();
  add_option(*verb, "CLIPS", options->clips, "A motion file, a folder or a manifest (.csv)")
      ->required();
  add_option(*verb, "--model FILE", options->model, "Model to measure")->required();
  add_option(*verb, "--strength NUMBER", options->strength, "Of each style; default 1");
  verb->add_flag(
      "--by-clip", options->by_clip,
      "Also a line per clip: jumps, thighs and knees beyond, upright and crouching, worst");
  verb->footer("Example:\n  panache-lab outputs others.csv --model model.safetensors");
  verb->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace panache::cli
