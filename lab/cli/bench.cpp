// panache-lab bench: speed on this machine, compared with other libraries and systems.

#include <memory>
#include <optional>
#include <string>

#include "base/progress.h"
#include "bench/run.h"
#include "bench_systems.h"
#include "messages.h"
#include "model_path.h"
#include "lab_verbs.h"

namespace panache::cli {
namespace {

constexpr int64_t kQuickSteps = 100'000;

struct BenchFlags {
  std::string model, systems, styles;
  int64_t steps = 1'000'000;
  bool quick = false, json = false;
};

int run(const BenchFlags& options) {
  need(check_range("--steps", static_cast<double>(options.steps), 1, 1e9), kBadUsage);
  bench::Options bench_options;
  bench_options.model = need(find_model(options.model, kFloatModel));
  bench_options.walker_model = need(find_shipped(kWalkerModel));
  bench_options.steps = options.quick ? kQuickSteps : options.steps;
  // Before the process is pinned to a core.
  std::optional<BuiltSystems> systems;
  if (!options.systems.empty()) {
    systems = need(build_systems(options.systems, options.styles, bench_options.model));
  }
  const bench::Measurements measured = need([&] {
    Progress progress("measuring");
    return bench::measure_all(bench_options, [&](double share) { progress.update(share); });
  }());
  std::vector<SystemTime> times;
  if (systems) times = systems->time();
  if (options.json) {
    print(to_json(measured, times));
  } else {
    print(describe(measured, times));
  }
  return kDone;
}

}  // namespace

void add_bench(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<BenchFlags>();
  CLI::App* verb = app.add_subcommand("bench", "Measure the speed of networks and steps");
  verb->add_option("--model", options->model,
                   "Model as floats, timed as it is and in int8; default:\n$PANACHE_MODEL, else "
                   "the one shipped");
  verb->add_option("--steps", options->steps, "Steps to time; other measurements scale with it")
      ->capture_default_str();
  verb->add_flag("--quick", options->quick, "A tenth of everything")->excludes("--steps");
  CLI::Option* systems = verb->add_option(
      "--systems", options->systems,
      "A manifest: builds the systems of other papers from its takes, and times a frame of each");
  verb->add_option("--styles", options->styles,
                   "For --systems: which styles, as in panache-lab train")
      ->needs(systems);
  verb->add_flag("--json", options->json, "Print JSON");
  verb->footer(
      "Everything runs on one core; nothing else should run meanwhile. Libraries to compare with "
      "are\n"
      "loaded from the folder bench next to the program, where ./run bench puts them.\n\n"
      "Example:\n  panache-lab bench --quick");
  verb->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace panache::cli
