#include "bench_systems.h"

#include <algorithm>
#include <filesystem>

#include "eval/systems/model_system.h"
#include "eval/systems/table.h"
#include "manifests.h"
#include "train/training_data.h"

namespace panache::cli {

std::vector<SystemTime> BuiltSystems::time() const {
  std::vector<SystemTime> times;
  for (const std::unique_ptr<System>& system : systems) {
    times.push_back({system->name(), system->step_us(input), system->facts().bytes});
  }
  return times;
}

Result<BuiltSystems> build_systems(const std::string& manifest, const std::string& styles,
                                   const std::string& model) {
  ManifestOptions options;
  options.paths = {manifest};
  options.styles = styles;
  Result<Manifests> data = read_manifests(options);
  if (!data) return data.error();
  // The motion to time them on: a neutral take that is not trained on, if there is one.
  const auto neutral = std::find_if(data->rows.begin(), data->rows.end(),
                                    [](const ManifestRow& r) { return r.neutral && r.test; });
  const ManifestRow& row = neutral == data->rows.end() ? data->rows.front() : *neutral;
  Result<TestInput> input = load_input(row);
  if (!input) return input.error();
  Result<TrainingData> training = prepare_training(data->rows, PoseLayout::positions);
  if (!training) return training.error();

  std::vector<std::unique_ptr<System>> systems;
  Result<std::shared_ptr<const Model>> ours = Model::load(model);
  if (!ours) return ours.error();
  std::error_code status;
  const size_t bytes = std::filesystem::file_size(model, status);
  systems.push_back(std::make_unique<ModelSystem>(std::filesystem::path(model).stem().string(),
                                                  *ours, status ? 0 : bytes));
  for (const SystemEntry& entry : published_systems()) {
    Result<std::unique_ptr<System>> system =
        entry.make(entry.name, {training->takes, training->pairings, data->styles, 1, {}});
    if (!system) return system.error();
    systems.push_back(*std::move(system));
  }
  return BuiltSystems{*std::move(input), std::move(systems)};
}

}  // namespace panache::cli
