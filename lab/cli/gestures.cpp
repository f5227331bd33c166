// panache-lab gestures: finds the gestures of a model's styles in their training takes.

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "lab_verbs.h"
#include "learn/find_gestures.h"
#include "learn/style_file.h"
#include "manifests.h"
#include "messages.h"
#include "model_path.h"
#include "takes/load_takes.h"

namespace panache::cli {
namespace {

struct GesturesFlags {
  ManifestOptions data;
  std::vector<std::string> models, of, actions;
};

bool is_listed(const std::vector<std::string>& list, const std::string& name) {
  return std::ranges::find(list, name) != list.end();
}

// The styled and neutral takes of a style, without those that are held out.
std::vector<ManifestRow> rows_of(const Manifests& data, const std::string& style,
                                 const std::vector<std::string>& actions) {
  std::vector<ManifestRow> rows;
  for (const ManifestRow& row : data.rows) {
    if (row.test || !(row.neutral || row.style == style)) continue;
    if (actions.empty() || is_listed(actions, row.content)) rows.push_back(row);
  }
  return rows;
}

struct Found {
  std::vector<Gesture> gestures;
  float rate;  // Per second.
};
Found find(const Manifests& data, const std::string& style,
           const std::vector<std::string>& actions) {
  const std::vector<Take> takes =
      need(load_takes(rows_of(data, style, actions), PoseLayout::positions));
  std::vector<int> styled, neutral;
  for (size_t t = 0; t < takes.size(); ++t) {
    (takes[t].row.neutral ? neutral : styled).push_back(static_cast<int>(t));
  }
  const std::vector<Pairing> pairings = pair_takes(takes, styled, neutral);
  const FoundGestures all = find_gestures(takes, pairings);
  std::vector<Gesture> gestures;
  for (const FoundGesture& found : all.gestures) {
    print(style + ": " + found.gesture.name() + ", in " +
          takes[static_cast<size_t>(found.take)].row.take + " at " + fixed(found.start, 1) +
          " s\n");
    gestures.push_back(found.gesture);
  }
  print(style + ": " + fixed(double{all.rate}, 2) + " such moments a second\n");
  return {gestures, all.rate};
}

int run(const GesturesFlags& options) {
  const Manifests data = need(read_manifests(options.data));
  need(check_files(data.rows));
  std::vector<TensorFile> models;
  for (const std::string& path : options.models) models.push_back(need(read_tensors(path)));
  for (const std::string& style : options.of) {
    const Found found = find(data, style, options.actions);
    for (size_t m = 0; m < models.size(); ++m) {
      models[m] =
          need(set_gestures(models[m], style, found.gestures, found.rate, options.models[m]));
    }
  }
  for (size_t m = 0; m < models.size(); ++m) need(replace_model(options.models[m], models[m]));
  return kDone;
}

}  // namespace

void add_gestures(CLI::App& app, int& exit_code) {
  CLI::App* verb =
      app.add_subcommand("gestures", "Find the gestures of styles in their takes, for models");
  auto options = std::make_shared<GesturesFlags>();
  add_manifest_options(*verb, options->data)->required();
  add_option(*verb, "--model FILE", options->models,
             "Model whose styles get the gestures; may be given several times")
      ->required()
      ->allow_extra_args(false);
  add_option(*verb, "--of NAME", options->of,
             "Style to find the gestures of; it loses those that it has.\nOne --of per style")
      ->required()
      ->allow_extra_args(false);
  add_option(*verb, "--action NAME", options->actions,
             "Action (column content) of the takes to look in; default:\nall. One --action "
             "per action")
      ->allow_extra_args(false);
  verb->footer(
      "Example:\n"
      "  panache-lab gestures takes.csv --model model.safetensors --of scared --action walk");
  verb->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace panache::cli
