// panache-lab persons: measures the persons of a model beside real people.

#include <memory>
#include <string>
#include <vector>

#include "eval/persons.h"
#include "lab_verbs.h"
#include "manifests.h"
#include "messages.h"
#include "takes/load_takes.h"

namespace panache::cli {
namespace {

struct PersonsFlags {
  std::vector<std::string> manifests, walks, others;
  std::string model, bank;
  int seeds = 20, other_seeds = 5;
  float variety = 1;
};

std::vector<TestInput> inputs_of(const std::vector<std::string>& files) {
  std::vector<ManifestRow> rows;
  for (const std::string& file : files) rows.emplace_back().path = file;
  return need(load_inputs(rows));
}

std::string describe(const PersonSpread& spread) {
  return fixed(spread.median_cm, 2) + " cm apart, 90 % " + fixed(spread.p90_cm, 2);
}

void print_changes(const std::string& what, const std::vector<OodRow>& rows) {
  const ChangeSummary of = summarize_changes(rows);
  print(what + ": " + plural(of.clips, "clip") + ", jerk / input " + fixed(of.jerk_median, 2) +
        ", 90 % " + fixed(of.jerk_p90, 2) + "; beyond limits " + fixed(100 * of.beyond_limits, 2) +
        " % of frames; jumps " + fixed(of.jumps, 3) + " a clip; sliding " +
        fixed(100 * of.more_sliding, 1) + " % more; " + fixed(of.cm, 1) + " cm from the input\n");
}

int measure(const PersonsFlags& options) {
  Manifests data = need(read_manifests({options.manifests, "", {}}));
  std::erase_if(data.rows, [](const ManifestRow& row) { return !row.neutral; });
  const auto model = need(Model::load(options.model));
  need(check_has_persons(*model));
  const std::vector<Take> takes = need(load_takes(data.rows, PoseLayout::positions));
  const auto persons = need(PersonsMeasure::create(takes, inputs_of(options.walks)));
  const RealPeople& real = persons.real();
  print("real: " + std::to_string(real.people) + " people, " + describe(real.spread) +
        ", takes of one " + fixed(real.own_cm, 2) + "; told " + fixed(real.told, 3) + " of " +
        std::to_string(real.told_of) + "; six numbers carry " + fixed(real.kept, 2) + "\n");
  const SeedPersons seeds = need(persons.measure(model, options.seeds, options.variety));
  print("seeds: " + std::to_string(seeds.seeds) + " on " + plural(seeds.walks, "walk") + ", " +
        describe(seeds.spread) + "; told " + fixed(seeds.told, 3) + "; outside " +
        fixed(seeds.outside, 3) + "\n");
  if (!options.bank.empty()) {
    size_t people = 0;
    const auto bank = need(NeutralBank::load(options.bank));
    const std::vector<double> agree = need(measure_retelling(model, *bank, takes, people));
    std::string text = "numbers from two walks of " + plural(people, "person") + " correlate:";
    for (size_t a = 0; a < agree.size(); ++a) {
      text += (a ? ", " : " ") + model->persons()->names()[a] + " " + fixed(agree[a], 2);
    }
    print(text + "\n");
  }
  if (options.others.empty()) return kDone;
  std::vector<std::string> files;
  for (const std::string& path : options.others) {
    const std::vector<std::string> found = need(list_ood(path));
    files.insert(files.end(), found.begin(), found.end());
  }
  const std::vector<TestInput> inputs = inputs_of(files);
  print_changes("persons on other motion",
                need(measure_persons_on(inputs, model, options.other_seeds, options.variety)));
  // What the styles do there.
  std::vector<OodRow> styled;
  for (const TestInput& input : inputs) {
    for (size_t style = 0; style < model->styles().size(); style += 6) {
      const Take take = need(play_person(input, model, -1, 0, static_cast<int>(style)));
      styled.push_back(compare_ood(input.take, take));
    }
  }
  print_changes("styles on other motion", styled);
  return kDone;
}

}  // namespace

void add_persons(CLI::App& app, int& exit_code) {
  CLI::App* verb =
      app.add_subcommand("persons", "Measure the persons of a model beside real people");
  auto options = std::make_shared<PersonsFlags>();
  verb->add_option("MANIFEST", options->manifests,
                   "Manifests with neutral walks of many people on one skeleton")
      ->required();
  add_option(*verb, "--model FILE", options->model, "Model with persons")->required();
  add_option(*verb, "--walk FILE", options->walks,
             "Neutral walk of somebody outside the training; two or more")
      ->required()
      ->allow_extra_args(false);
  add_option(*verb, "--other PATH", options->others, "Other motion: a file, a folder or a manifest")
      ->allow_extra_args(false);
  add_option(*verb, "--bank FILE", options->bank,
             "Bank of neutral motion: how well the numbers of real people\nare found again");
  add_option(*verb, "--seeds NUMBER", options->seeds, "Persons on the walks; default: 20")
      ->check(CLI::Range(2, 1000));
  add_option(*verb, "--variety AMOUNT", options->variety, "See panache stylize; default: 1")
      ->check(CLI::Range(0.0f, kMaxVariety));
  verb->footer(
      "Example:\n"
      "  panache-lab persons takes.csv --model model.safetensors --walk a.bvh --walk b.bvh");
  verb->callback([options, &exit_code] { exit_code = measure(*options); });
}

}  // namespace panache::cli
