#include "eval/systems/mean_posture.h"

#include <algorithm>

#include "eval/systems/model_system.h"
#include "learn/samples.h"
#include "recipes/recipes.h"

namespace panache {
namespace {

// What every pair of a style has in the mean.
struct MeanChange {
  std::array<double, StyleDelta::kSize> change{};
  double log_rate = 0, count = 0;
};

}  // namespace

std::vector<Model::ConstantStyle> mean_changes(const SystemData& data) {
  std::vector<std::string> names;
  names.reserve(data.styles.size());
  for (const StyleName& style : data.styles) names.push_back(style.name);
  const SampleSet set(data.takes, data.pairings, names, default_recipe(), false);
  std::vector<MeanChange> sums(names.size());
  for (size_t i = 0; i < set.samples().size(); ++i) {
    MeanChange& sum = sums[set.samples()[i].style];
    const std::span<const float> target = set.target(i);
    for (int n = 0; n < StyleDelta::kSize; ++n) sum.change[n] += target[n];
    sum.log_rate += set.samples()[i].log_rate;
    ++sum.count;
  }
  std::vector<Model::ConstantStyle> styles;
  for (size_t s = 0; s < sums.size(); ++s) {
    const double count = std::max(1.0, sums[s].count);
    Model::ConstantStyle& style = styles.emplace_back(
        StyleInfo{names[s], data.styles[s].description, "", false, data.styles[s].group});
    std::array<float, StyleDelta::kSize> change;
    for (int n = 0; n < StyleDelta::kSize; ++n) {
      change[n] = static_cast<float>(sums[s].change[n] / count);
    }
    style.change = unpack(change);
    style.log_rate = static_cast<float>(sums[s].log_rate / count);
  }
  return styles;
}

Result<std::unique_ptr<System>> make_mean_posture(const std::string& name, const SystemData& data) {
  return std::unique_ptr<System>(
      std::make_unique<ModelSystem>(name, Model::of_constants(mean_changes(data))));
}

}  // namespace panache
