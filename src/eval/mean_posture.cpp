#include "eval/mean_posture.h"

#include <algorithm>
#include <cmath>

#include "net/safetensors.h"
#include "train/export.h"
#include "learn/samples.h"

namespace panache {
namespace {

// What every pair of a style has in the mean.
struct MeanChange {
  std::array<double, StyleDelta::kSize> change{};
  double log_rate = 0, count = 0;
};

Tensor constants(std::vector<int64_t> shape, std::vector<float> values) {
  return {std::move(shape), std::move(values), false};
}

// A network that answers with its heads' biases alone.
void add_constant_network(TensorFile& file, const std::string& name, int inputs,
                          const std::vector<std::vector<float>>& biases) {
  file.tensors[name + ".trunk.0.weight"] = constants({inputs, 1}, std::vector<float>(inputs));
  file.tensors[name + ".trunk.0.bias"] = constants({1}, {0});
  for (size_t h = 0; h < biases.size(); ++h) {
    const std::string head = name + ".head." + std::to_string(h);
    const int64_t outputs = static_cast<int64_t>(biases[h].size());
    file.tensors[head + ".weight"] = constants({1, outputs}, std::vector<float>(biases[h].size()));
    file.tensors[head + ".bias"] = constants({outputs}, biases[h]);
  }
}

}  // namespace

Result<std::shared_ptr<const Model>> mean_posture_model(const TrainingData& data,
                                                        const std::vector<StyleName>& styles,
                                                        const std::vector<std::string>& without) {
  std::vector<std::string> names;
  for (const StyleName& style : styles) names.push_back(style.name);
  std::vector<Pairing> pairings;
  for (const Pairing& pairing : data.pairings) {
    const std::string& content = data.takes[pairing.styled].row.content;
    if (std::find(without.begin(), without.end(), content) == without.end()) {
      pairings.push_back(pairing);
    }
  }
  const SampleSet set(data.takes, pairings, names, default_recipe(), false);
  std::vector<MeanChange> sums(names.size());
  for (size_t i = 0; i < set.samples().size(); ++i) {
    MeanChange& sum = sums[set.samples()[i].style];
    const std::span<const float> target = set.target(i);
    for (int n = 0; n < StyleDelta::kSize; ++n) sum.change[n] += target[n];
    sum.log_rate += set.samples()[i].log_rate;
    ++sum.count;
  }

  constexpr float kNeverPlanted = -20;  // Before the logistic function.
  std::vector<std::vector<float>> pose, timing,
      contact(1, std::vector<float>(kFeet, kNeverPlanted));
  for (const MeanChange& sum : sums) {
    const double count = std::max(1.0, sum.count);
    std::vector<float> change;
    for (const double c : sum.change) change.push_back(static_cast<float>(c / count));
    pose.push_back(std::move(change));
    timing.push_back({static_cast<float>(sum.log_rate / count)});
    contact.push_back(std::vector<float>(kFeet, 0.0f));
  }
  TensorFile file;
  file.metadata = model_metadata(default_recipe(), styles);
  const int numbers = set.numbers();
  file.tensors["input.mean"] = constants({numbers}, set.mean());
  file.tensors["input.scale"] = constants({numbers}, set.scale());
  file.tensors["input.clip"] = constants({1}, {0});
  file.tensors["output.scale"] =
      constants({StyleDelta::kSize}, std::vector<float>(StyleDelta::kSize, 1));
  add_constant_network(file, "pose", set.inputs(), pose);
  add_constant_network(file, "timing", set.inputs(), timing);
  add_constant_network(file, "contact", set.inputs(), contact);
  return Model::create(file, "mean posture");
}

}  // namespace panache
