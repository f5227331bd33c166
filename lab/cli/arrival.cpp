// panache-lab arrival: how much of each style's movement and side arrives on walks.

#include <cmath>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "eval/arrival.h"
#include "eval/claims.h"
#include "eval/systems/model_system.h"
#include "lab_verbs.h"
#include "manifests.h"
#include "messages.h"
#include "model_path.h"
#include "takes/load_takes.h"
#include "takes/manifest.h"

namespace panache::cli {
namespace {

struct ArrivalFlags {
  ManifestOptions data;
  std::vector<std::string> models;
};

std::string cell(double value, int digits = 2) {
  std::string text = std::isfinite(value) ? fixed(value, digits) : "-";
  return std::string(text.size() < 7 ? 7 - text.size() : 1, ' ') + text;
}

std::string table(const std::vector<StyleArrival>& styles) {
  std::string text = padded("style", 16) + "walks   ";
  for (const MovementTrait& trait : kMovementTraits) {
    const std::string key(trait.key);
    text += ' ' + key.substr(0, 6) + std::string(key.size() < 6 ? 6 - key.size() : 0, ' ');
  }
  text += "   side steps/s (real)\n";
  for (const StyleArrival& style : styles) {
    const auto line = [&](const char* walks, const ArrivedShares& shares) {
      text += padded(style.style, 16) + padded(walks, 8);
      for (const double share : shares.movement) text += cell(share);
      text += cell(shares.side) + cell(shares.steps, 1);
      text += " (" + fixed(style.slowest, 1) + " to " + fixed(style.fastest, 1) + ")\n";
    };
    text += padded(style.style, 16) + padded("change", 8);
    for (const double change : style.change) text += cell(change);
    text += cell(style.side_cm, 1) + " cm\n";
    line("real", style.real);
    for (size_t w = 0; w < kWalksKeys.size(); ++w) line(kWalksKeys[w], style.made[w]);
  }
  return text;
}

std::string summary(const char* walks, const ArrivalSummary& of) {
  std::string text = padded(walks, 8) + "movement" + cell(of.median) + " (" +
                     std::to_string(of.traits) + " traits), below half" + cell(of.below_half) +
                     ", wrong sign" + cell(of.wrong_sign) + "; side" + cell(of.side) + " (" +
                     std::to_string(of.sided) + " styles); in step " + std::to_string(of.in_step) +
                     "; by trait";
  for (size_t t = 0; t < of.by_trait.size(); ++t) {
    text += std::string(" ") + kMovementTraits[t].key + ' ' + fixed(of.by_trait[t], 2);
  }
  return text + "\n";
}

// The styles that look like the input or like another style on the walker's walks, and the words of
// descriptions that do not show there.
std::string complaints(const std::vector<StyleArrival>& styles,
                       const std::vector<StyleName>& names) {
  constexpr double kAlike = 5;  // cm
  std::string text;
  for (const StyleArrival& style : styles) {
    if (style.from_input_cm < kAlike) {
      text += style.style + ": " + fixed(style.from_input_cm, 1) +
              " cm from a neutral walk; real takes " + fixed(style.real_from_neutral_cm, 1) + "\n";
    }
    if (style.nearest_cm < kAlike) {
      text += style.style + ": " + fixed(style.nearest_cm, 1) + " cm from " + style.nearest +
              "; real takes " + fixed(style.real_nearest_cm, 1) + "\n";
    }
    for (const StyleName& name : names) {
      if (name.name != style.style) continue;
      for (const std::string& words : unshown(name.description, style)) {
        text += style.style + ": its description says '" + words + "', which does not show\n";
      }
    }
  }
  return text;
}

int run(const ArrivalFlags& options) {
  const Manifests data = need(read_manifests(options.data));
  need(check_files(data.rows));
  std::vector<ManifestRow> training, test, neutral, others;
  for (const ManifestRow& row : data.rows) {
    if (row.content != kWalk) continue;
    (!row.test ? training : row.neutral ? neutral : test).push_back(row);
  }
  for (const ManifestRow& row : data.unlabelled) {
    if (row.test && row.content == kWalk) others.push_back(row);
  }
  const std::vector<Take> takes = need(load_takes(training, PoseLayout::positions));
  const std::vector<Take> held_out = need(load_takes(test, PoseLayout::positions));
  const std::vector<TestInput> inputs = need(load_inputs(neutral));
  const std::vector<TestInput> strangers = need(load_inputs(others));
  const std::vector<TestInput> walker = need(walker_walks(need(find_shipped(kWalkerModel))));
  const WalkSet walks(takes, held_out, inputs, strangers, walker);
  for (const std::string& path : options.models) {
    const ModelSystem system(std::filesystem::path(path).stem().string(), need(Model::load(path)));
    const std::vector<StyleArrival> styles = need(walks.measure(system));
    print(path + "\n" + table(styles) + summary("real", summarize(styles, real_shares)) +
          summary("own", summarize(styles, made_shares<Walks::own>)) +
          summary("others", summarize(styles, made_shares<Walks::others>)) +
          summary("walker", summarize(styles, made_shares<Walks::walker>)) +
          complaints(styles, data.styles));
  }
  return kDone;
}

}  // namespace

void add_arrival(CLI::App& app, int& exit_code) {
  CLI::App* verb = app.add_subcommand(
      "arrival", "Measure how much of each style's movement and side arrives on walks");
  auto options = std::make_shared<ArrivalFlags>();
  add_manifest_options(*verb, options->data)->required();
  add_option(*verb, "--model FILE", options->models, "Model to measure; may be given several times")
      ->required()
      ->allow_extra_args(false);
  verb->footer(
      "Example:\n"
      "  panache-lab arrival takes.csv --unlabelled others.csv --model model.safetensors");
  verb->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace panache::cli
