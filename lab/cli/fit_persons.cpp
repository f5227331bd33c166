// panache-lab fit-persons: fits the space of persons to the neutral motion of many people.

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "eval/persons.h"
#include "lab_verbs.h"
#include "manifests.h"
#include "messages.h"
#include "model_path.h"
#include "takes/load_takes.h"
#include "train/persons.h"

namespace panache::cli {
namespace {

constexpr int kSeeds = 40;  // Whose spread is compared with that of real people.
constexpr int kRounds = 3;

struct FitPersonsFlags {
  std::vector<std::string> manifests, models;
  std::string bank;
  PersonSettings settings;
};

// At most this many walks of different people, to calibrate on.
std::vector<TestInput> walks_of(const std::vector<Take>& takes, size_t count) {
  std::map<std::string, ManifestRow> rows;
  for (const Take& take : takes) {
    const bool plain = take.row.content == "walk" && take.frames() >= 90;
    if (plain && !take.row.test) rows.emplace(person_of(take), take.row);
  }
  std::vector<ManifestRow> chosen;
  size_t at = 0;
  for (const auto& [person, row] : rows) {
    if (at++ * count / rows.size() == chosen.size() && chosen.size() < count) chosen.push_back(row);
  }
  return need(load_inputs(chosen));
}

int fit(const FitPersonsFlags& options) {
  Manifests data = need(read_manifests({options.manifests, "", {}}));
  std::erase_if(data.rows, [](const ManifestRow& row) { return row.test || !row.neutral; });
  need(check_files(data.rows));
  std::vector<TensorFile> models;
  for (const std::string& path : options.models) models.push_back(need(read_tensors(path)));
  const auto bank = need(NeutralBank::load(options.bank));
  const std::vector<Take> takes = need(load_takes(data.rows, PoseLayout::positions));
  const FittedPersons persons = need(fit_persons(models.front(), *bank, takes, options.settings));
  double seconds = 0;
  for (const auto& [person, own] : persons.seconds) seconds += own;
  print(std::to_string(persons.people.size()) + " people, " + fixed(seconds, 0) +
        " s of walks and runs; the axes carry " + fixed(100 * persons.kept, 0) +
        " % of what differs\n");
  for (const PersonAxis& axis : persons.axes) {
    print("  " + axis.name + ": " + fixed(100 * axis.share, 0) + " %, correlation " +
          fixed(axis.correlation, 2) + "\n");
  }
  // The regressions answer with too little; seeds shall differ by as much as real people.
  const auto measure = need(PersonsMeasure::create(takes, walks_of(takes, 4)));
  const PersonSpread& real = measure.real().spread;
  print("real people: " + fixed(real.median_cm, 2) + " cm apart, 90 % " + fixed(real.p90_cm, 2) +
        "\n");
  double gain = 1;
  for (int round = 0; round < kRounds; ++round) {
    const auto model =
        need(Model::create(with_persons(models.front(), persons, gain), options.models.front()));
    const SeedPersons seeds = need(measure.measure(model, kSeeds));
    print("gain " + fixed(gain, 2) + ": seeds " + fixed(seeds.spread.median_cm, 2) +
          " cm apart, 90 % " + fixed(seeds.spread.p90_cm, 2) + ", told " + fixed(seeds.told, 2) +
          ", outside " + fixed(seeds.outside, 3) + "\n");
    // Real people have more outliers than a normal distribution: in the middle of both.
    gain *= std::sqrt(real.median_cm / seeds.spread.median_cm * real.p90_cm / seeds.spread.p90_cm);
  }
  print("gain " + fixed(gain, 2) + "\n");
  for (size_t m = 0; m < models.size(); ++m) {
    need(replace_model(options.models[m], with_persons(models[m], persons, gain)));
  }
  return kDone;
}

}  // namespace

void add_fit_persons(CLI::App& app, int& exit_code) {
  CLI::App* verb =
      app.add_subcommand("fit-persons", "Fit how people differ, for panache stylize --person");
  auto options = std::make_shared<FitPersonsFlags>();
  verb->add_option("MANIFEST", options->manifests,
                   "Manifests with neutral takes of many people; without a column\nperson, files "
                   "are called PERSON_TAKE")
      ->required();
  add_option(*verb, "--model FILE", options->models,
             "Model that gets the persons; the first is fitted to. May be\ngiven several times")
      ->required()
      ->allow_extra_args(false);
  add_option(*verb, "--bank FILE", options->bank, "Bank of neutral motion")->required();
  add_option(*verb, "--axes NUMBER", options->settings.axes, "Numbers of a person; default: 8")
      ->check(CLI::Range(1, static_cast<int>(kMaxPersonAxes)));
  add_option(*verb, "--units NUMBER", options->settings.units,
             "Combinations of activations that they read; default: 24")
      ->check(CLI::Range(16, static_cast<int>(kMaxPersonUnits)));
  add_option(*verb, "--penalty NUMBER", options->settings.penalty,
             "Penalty of a person's regression; default: 3")
      ->check(CLI::PositiveNumber);
  verb->footer(
      "Example:\n"
      "  panache-lab fit-persons takes.csv --model model.safetensors --bank neutral.safetensors");
  verb->callback([options, &exit_code] { exit_code = fit(*options); });
}

}  // namespace panache::cli
