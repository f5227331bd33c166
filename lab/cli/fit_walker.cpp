// panache-lab fit-walker: fits the model of panache walker to neutral takes.

#include <memory>
#include <string>
#include <vector>

#include "base/file.h"
#include "lab_verbs.h"
#include "manifests.h"
#include "messages.h"
#include "outputs.h"
#include "train/fit_walker.h"

namespace panache::cli {
namespace {

struct FitWalkerFlags {
  std::string output;
  std::vector<std::string> manifests;
  std::string data, licence;  // For the metadata of the model.
  bool force = false;
};

int fit(const FitWalkerFlags& options) {
  need(check_free(options.output, options.force));
  const Manifests data = need(read_manifests({options.manifests, "", {}}));
  const FittedWalker fitted = need(fit_walker(data.rows, options.data, options.licence));
  need(write_file(options.output, fitted.model.format(), options.force));
  print("fitted " + options.output + " to " + std::to_string(fitted.walk_frames) +
        " frames of walk and " + std::to_string(fitted.run_frames) + " of run in " +
        plural(static_cast<size_t>(fitted.takes), "take") + "; residual " +
        brief(fitted.walk_residual, 3) + " rad walking, " + brief(fitted.run_residual, 3) +
        " running\n");
  return kDone;
}

}  // namespace

void add_fit_walker(CLI::App& app, int& exit_code) {
  CLI::App* verb = app.add_subcommand("fit-walker", "Fit the model of panache walker");
  auto options = std::make_shared<FitWalkerFlags>();
  verb->add_option("MANIFEST", options->manifests, "Manifests with neutral takes to fit to")
      ->required();
  add_option(*verb, "-o,--output OUT", options->output, "Model to write (.safetensors)")
      ->required();
  add_option(*verb, "--data TEXT", options->data, "Name of the data, for the model's metadata");
  add_option(*verb, "--licence TEXT", options->licence, "Licence of the data, likewise");
  verb->add_flag("--force", options->force, "Overwrite the file");
  verb->footer("Example:\n  panache-lab fit-walker takes.csv -o walker.safetensors");
  verb->callback([options, &exit_code] { exit_code = fit(*options); });
}

}  // namespace panache::cli
