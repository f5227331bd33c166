// panache-lab learning: how well styles are learnt from one clip, with and without a neutral clip.

#include <memory>
#include <string>
#include <vector>

#include "eval/learning.h"
#include "lab_verbs.h"
#include "manifests.h"
#include "messages.h"
#include "model_path.h"
#include "takes/load_takes.h"

namespace panache::cli {
namespace {

struct LearningFlags {
  std::vector<std::string> manifests;
  std::string model, bank;
};

int measure(const LearningFlags& options) {
  const Manifests data = need(read_manifests({options.manifests, "", {}}));
  const TensorFile model = need(read_tensors(options.model));
  const auto bank = need(NeutralBank::load(options.bank));
  const std::vector<Take> takes = need(load_takes(data.rows, PoseLayout::positions));
  const auto found = need(measure_learning(model, *bank, takes));
  std::string text =
      "cm off: no style, mean posture of the pair, learnt from the pair, from the clip alone\n";
  for (const auto& [action, errors] : found) {
    std::string line = action + " (" + plural(static_cast<size_t>(errors.styles), "style") + ")";
    line.resize(std::max<size_t>(line.size() + 1, 28), ' ');
    for (const double cm : {errors.none, errors.posture, errors.pair, errors.alone}) {
      line += "  " + fixed(cm, 2);
    }
    text += line + "  (" + fixed(errors.seconds, 2) + " s, " + fixed(errors.people, 0) +
            " people, certainty " + fixed(errors.certainty, 2) + ", known " +
            fixed(100 * errors.known, 0) + " %)\n";
  }
  print(text);
  return kDone;
}

}  // namespace

void add_learning(CLI::App& app, int& exit_code) {
  CLI::App* verb = app.add_subcommand(
      "learning", "Measure learning from one clip of a style, with a neutral clip and without");
  auto options = std::make_shared<LearningFlags>();
  verb->add_option("MANIFEST", options->manifests,
                   "Manifests with styled and neutral takes; takes marked test judge")
      ->required();
  add_option(*verb, "--model FILE", options->model, "Model to learn on")->required();
  add_option(*verb, "--bank FILE", options->bank, "Bank of neutral motion")->required();
  verb->footer(
      "Example:\n"
      "  panache-lab learning takes.csv --model model.safetensors --bank neutral.safetensors");
  verb->callback([options, &exit_code] { exit_code = measure(*options); });
}

}  // namespace panache::cli
