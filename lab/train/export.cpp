#include "train/export.h"

#include <algorithm>
#include <cmath>

#include "style/model/model.h"
#include "style/networks/networks.h"
#include "takes/manifest.h"

namespace panache {
namespace {

Tensor vector_tensor(const std::vector<float>& values) {
  return {{static_cast<int64_t>(values.size())}, values, false};
}

}  // namespace

std::vector<NetworkShape> network_shapes(const SampleSet& set, int styles) {
  const bool heads = set.recipe().style_heads;
  const int inputs = set.inputs() + set.recipe().style_inputs(styles);
  const int per_style = heads ? styles : 1;
  return {{"pose", inputs, 128, 3, set.outputs(), per_style, false, heads},
          {"timing", inputs, 64, 3, 1, per_style, false, false},
          {"contact", inputs, 32, 3, kFeet, heads ? styles + 1 : 1, heads, false}};
}

std::map<std::string, std::string> model_metadata(const Recipe& recipe,
                                                  const std::vector<StyleName>& styles) {
  std::string names, descriptions, groups, words, sides;
  for (const StyleName& style : styles) {
    names += style.name + "\n";
    descriptions += style.description + "\n";
    groups += style.group + "\n";
    words += style.words + "\n";
    sides += style.side + "\n";
  }
  std::map<std::string, std::string> metadata = {
      {"format", "panache"},
      {"format_version", "1"},
      {"recipe", recipe.name},
      {"joints", canonical_joint_list()},
      {"window", window_description()},
      {"layout", recipe.layout_text},
      {"styles", names},
      {"style_descriptions", descriptions},
  };
  const auto has_group = [](const StyleName& style) { return !style.group.empty(); };
  if (std::ranges::any_of(styles, has_group)) metadata["style_groups"] = groups;
  const auto has_words = [](const StyleName& style) { return !style.words.empty(); };
  if (std::ranges::any_of(styles, has_words)) metadata["style_words"] = words;
  const auto has_side = [](const StyleName& style) { return !style.side.empty(); };
  if (std::ranges::any_of(styles, has_side)) metadata["style_sides"] = sides;
  return metadata;
}

namespace {

// A model file without networks: metadata and input normalisation.
TensorFile model_header(const Recipe& recipe, const std::vector<StyleName>& styles,
                        const TrainOptions& options, const InputUnits& inputs, float input_clip) {
  TensorFile file;
  file.metadata = model_metadata(recipe, styles);
  file.metadata["data"] = options.data;
  file.metadata["licence"] = options.licence;
  file.metadata["seed"] = std::to_string(options.seed);
  file.tensors["input.mean"] = vector_tensor(inputs.mean);
  file.tensors["input.scale"] = vector_tensor(inputs.scale);
  file.tensors["input.clip"] = vector_tensor({input_clip});
  if (recipe.output_scale) file.tensors["output.scale"] = vector_tensor(recipe.output_scale());
  return file;
}

}  // namespace

TensorFile export_model(const SampleSet& set, const OutputUnits& units,
                        const std::vector<StyleName>& styles,
                        const std::vector<NetworkTrainer>& networks, const TrainOptions& options) {
  TensorFile file = model_header(set.recipe(), styles, options, {set.mean(), set.scale()},
                                 options.settings.batch.input_clip);
  file.metadata["steps"] = std::to_string(options.settings.steps);
  if (options.remover_of) file.metadata[kDirection] = kRemove;
  file.metadata["samples"] = std::to_string(set.samples().size());
  if (!set.recipe().output_scale) {
    file.tensors["output.mean"] = vector_tensor(units.mean);
    file.tensors["output.scale"] = vector_tensor(units.scale);
  }
  for (const NetworkTrainer& network : networks) network.write(file);
  return file;
}

Result<float> export_error(const TensorFile& model, const SampleSet& set, const BatchMaker& batches,
                           const std::vector<NetworkTrainer>& networks,
                           const std::vector<int>& samples) {
  Result<std::shared_ptr<const Model>> read =
      Model::parse(format_safetensors(model), "the exported model");
  if (!read) return read.error();
  StyleNetworks exported(*read);
  const int styles = static_cast<int>((*read)->styles().size());
  torch::NoGradGuard no_gradients;
  std::vector<float> strengths(styles), window(set.inputs());
  const size_t stride = std::max<size_t>(1, samples.size() / 200);
  float largest = 0;
  for (size_t i = 0; i < samples.size(); i += stride) {
    const Sample& sample = set.samples()[samples[i]];
    if (sample.style < 0) continue;
    std::fill(strengths.begin(), strengths.end(), 0.0f);
    strengths[sample.style] = 1;
    exported.set_strengths(strengths);
    set.window(samples[i], window);
    exported.forward(window);

    Batch batch = batches.plain({samples[i]});
    batch.group_sizes.assign(styles, 0);
    batch.group_sizes[sample.style] = 1;
    const auto expected = [&](int n) {
      return networks[n].forward(batch.inputs, batch.group_sizes, nullptr).contiguous();
    };
    const torch::Tensor pose = expected(0), timing = expected(1);
    const torch::Tensor contact = torch::sigmoid(expected(2));
    const std::vector<float>& scale = model.tensors.at("output.scale").values;
    for (int o = 0; o < set.outputs(); ++o) {
      const auto found = model.tensors.find("output.mean");
      const float mean = found == model.tensors.end() ? 0.0f : found->second.values[o];
      const float ours = (exported.pose()[o] - mean) / scale[o];
      largest = std::max(largest, std::abs(ours - pose.data_ptr<float>()[o]));
    }
    largest = std::max(largest, std::abs(exported.log_rate() - timing.item<float>()));
    for (int f = 0; f < kFeet; ++f) {
      largest = std::max(largest, std::abs(exported.contact()[f] - contact.data_ptr<float>()[f]));
    }
  }
  return largest;
}

}  // namespace panache
