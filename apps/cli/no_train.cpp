// panache train, panache eval and panache bench --systems where the program was built without them.

#include "bench_systems.h"
#include "messages.h"
#include "verbs.h"

namespace panache::cli {
namespace {

void add_missing(CLI::App& app, int& exit_code, const std::string& name, const std::string& what) {
  CLI::App* verb = app.add_subcommand(name, what + " (not in this build)");
  verb->allow_extras();
  verb->footer(
      "This program was built without training, which needs libtorch.\n\n"
      "Example, in a checkout of the sources (builds the program with training, and "
      "trains):\n  ./run train");
  verb->callback([name, &exit_code] {
    exit_code = fail({"this program was built without '" + name +
                      "', which needs libtorch; ./run train in a checkout of the sources "
                      "builds it with training, as build/dev/panache"},
                     kBadUsage);
  });
}

}  // namespace

void add_train(CLI::App& app, int& exit_code) {
  add_missing(app, exit_code, "train", "Train a model on your own motion");
}

void add_eval(CLI::App& app, int& exit_code) {
  add_missing(app, exit_code, "eval", "Evaluate models against real motion");
}

Result<std::unique_ptr<BuiltSystems>> build_systems(const std::string&, const std::string&,
                                                    const std::string&) {
  return Error{
      "--systems: this program was built without the systems of other papers, which need "
      "libtorch; use build/dev/panache, which ./run train builds"};
}

}  // namespace panache::cli
