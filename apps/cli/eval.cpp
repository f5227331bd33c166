// panache eval: models beside real motion.

#include <filesystem>

#include "eval/pose_error.h"
#include "manifests.h"
#include "report.h"
#include "verbs.h"

namespace panache::cli {
namespace {

struct Options {
  ManifestOptions data;
  std::vector<std::string> models;
  bool json = false;
};

Json table_json(const PoseErrorTable& table) {
  Json rows = Json::array();
  for (const PoseErrorRow& row : table.rows) {
    Json errors;
    for (size_t s = 0; s < table.systems.size(); ++s) {
      errors[table.systems[s]] = {{"pose_error_deg", row.errors[s].degrees},
                                  {"pose_error_cm", row.errors[s].cm}};
    }
    rows.push_back({{"style", row.style}, {"frames", row.frames}, {"systems", errors}});
  }
  return rows;
}

std::string table_text(const PoseErrorTable& table) {
  constexpr size_t kColumn = 22;
  std::string text = padded("style", 14) + padded("frames", 8);
  for (const std::string& system : table.systems) text += padded(system, kColumn);
  text += "\n";
  for (const PoseErrorRow& row : table.rows) {
    text += padded(row.style, 14) + padded(std::to_string(row.frames), 8);
    for (const PoseError& error : row.errors) {
      text += padded(fixed(error.degrees, 2) + " deg " + fixed(error.cm, 2) + " cm", kColumn);
    }
    text += "\n";
  }
  return text;
}

int run(const Options& options) {
  Result<Manifests> data = read_manifests(options.data);
  if (!data) return refuse(data.error(), kBadInput);
  std::vector<NamedModel> models;
  for (const std::string& path : options.models) {
    Result<std::shared_ptr<const Model>> model = Model::load(path);
    if (!model) return refuse(model.error(), kBadInput);
    models.push_back({std::filesystem::path(path).stem().string(), *model});
  }
  Result<PoseErrorTable> table = measure_pose_error(data->rows, models);
  if (!table) return refuse(table.error(), kBadInput);
  if (options.json) {
    print(table_json(*table));
  } else {
    print("Pose error against the time-aligned real styled take, test takes only:\n" +
          table_text(*table));
  }
  return kDone;
}

}  // namespace

void add_eval(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<Options>();
  CLI::App* verb = app.add_subcommand("eval", "Compare models with real motion");
  add_manifest_options(*verb, options->data);
  verb->add_option("--model", options->models, "A model to judge; may be given several times");
  verb->add_flag("--json", options->json, "Print the result as JSON");
  verb->footer("Example:\n  panache eval mine.csv --model mine.safetensors");
  verb->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace panache::cli
