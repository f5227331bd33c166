// panache styles: what a model can do.

#include <memory>
#include <string>

#include "model_path.h"
#include "model_report.h"
#include "report.h"
#include "verbs.h"

namespace panache::cli {
namespace {

int styles(const std::string& given, bool json) {
  Result<std::string> path = find_model(given);
  if (!path) return refuse(path.error(), kBadInput);
  Result<LoadedModel> loaded = load_model(*path);
  if (!loaded) return refuse(loaded.error(), kBadInput);
  if (json) {
    print(to_json(*loaded));
  } else {
    print(describe(*loaded));
  }
  return kDone;
}

}  // namespace

void add_styles(CLI::App& app, int& exit_code) {
  CLI::App* verb = app.add_subcommand("styles", "List the styles of a model");
  struct Options {
    std::string model;
    bool json = false;
  };
  auto options = std::make_shared<Options>();
  verb->add_option("MODEL", options->model, "Model; default: $PANACHE_MODEL, else the one shipped")
      ->type_name("");
  verb->add_flag("--json", options->json, "Print JSON");
  verb->footer("Example:\n  panache styles");
  verb->callback([options, &exit_code] { exit_code = styles(options->model, options->json); });
}

}  // namespace panache::cli
