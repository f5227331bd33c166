#pragma once
// A small model of random numbers, for tests that need a model and no particular one.

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "base/random.h"
#include "known_recipes.h"
#include "net/safetensors.h"
#include "pose/contacts.h"
#include "pose/features.h"
#include "style/model/model.h"

namespace panache::test {

inline Tensor random_tensor(const std::vector<int64_t>& shape, float deviation, Random& random) {
  Tensor tensor{shape, {}, false};
  size_t count = 1;
  for (const int64_t size : shape) count *= static_cast<size_t>(size);
  for (size_t i = 0; i < count; ++i) tensor.values.push_back(deviation * random.normal());
  return tensor;
}

inline Tensor constant_tensor(int size, float value) {
  return {{size}, std::vector<float>(static_cast<size_t>(size), value), false};
}

// Tensors of one network: two hidden layers of `hidden`, then `heads` heads.
inline void add_network(TensorFile& file, const std::string& name, int inputs, int hidden,
                        int outputs, int heads, Random& random) {
  const auto add_layer = [&](const std::string& layer, int in, int out) {
    const float deviation = 1 / std::sqrt(static_cast<float>(in));
    file.tensors[layer + ".weight"] = random_tensor({in, out}, deviation, random);
    file.tensors[layer + ".bias"] = random_tensor({out}, 0.1f, random);
  };
  add_layer(name + ".trunk.0", inputs, hidden);
  add_layer(name + ".trunk.1", hidden, hidden);
  for (int h = 0; h < heads; ++h) {
    add_layer(name + ".head." + std::to_string(h), hidden, outputs);
  }
}

// A valid model of a recipe with these styles. Its changes are visible and
// small: joints turn by about a tenth of a radian.
inline TensorFile make_model(const std::vector<std::string>& styles, uint64_t seed = 1,
                             const Recipe& recipe = kPanache) {
  const bool heads = recipe.style_heads;
  const int numbers = pose_feature_count(recipe.layout), count = static_cast<int>(styles.size());
  const int outputs = recipe.outputs;
  std::string names, descriptions;
  for (const std::string& style : styles) {
    names += style + "\n";
    descriptions += "looks " + style + "\n";
  }
  TensorFile file;
  file.metadata = {{"format", "panache"},
                   {"format_version", "1"},
                   {"recipe", recipe.name},
                   {"joints", canonical_joint_list()},
                   {"window", window_description()},
                   {"styles", names},
                   {"style_descriptions", descriptions},
                   {"licence", "CC0"}};
  file.tensors["input.mean"] = constant_tensor(numbers, 0);
  file.tensors["input.scale"] = constant_tensor(numbers, 1);
  file.tensors["input.clip"] = constant_tensor(1, 4);
  file.tensors["output.scale"] = constant_tensor(outputs, 0.1f);
  if (!recipe.output_scale) file.tensors["output.mean"] = constant_tensor(outputs, 0);
  Random random(seed);
  const int inputs = kWindowPoses * numbers + recipe.style_inputs(count);
  add_network(file, "pose", inputs, 16, outputs, heads ? count : 1, random);
  add_network(file, "timing", inputs, 8, 1, heads ? count : 1, random);
  add_network(file, "contact", inputs, 8, kFeet, heads ? count + 1 : 1, random);
  return file;
}

// Gives a model of make_model() a gate: features of the pose trunk within `limit` of their mean,
// which is `mean` throughout, are known. Distances are as they are, without whitening.
inline void add_gate(TensorFile& file, float limit, float mean = 0) {
  const int hidden = static_cast<int>(file.tensors.at("pose.trunk.1.bias").values.size());
  Tensor identity{{hidden, hidden}, std::vector<float>(size_t(hidden) * hidden), false};
  for (int i = 0; i < hidden; ++i) identity.values[size_t(i) * hidden + i] = 1;
  file.tensors["gate.mean"] = constant_tensor(hidden, mean);
  file.tensors["gate.whitening.weight"] = identity;
  file.tensors["gate.whitening.bias"] = constant_tensor(hidden, 0);
  file.tensors["gate.limit"] = constant_tensor(1, limit);
}

// Makes the pose heads of a model of make_model() read the activations of all layers: `added` is
// the size of the weights of those that heads do not read otherwise. The gate, if any, is around
// `mean`, at which the answers are those of the heads before.
inline void reduce_heads(TensorFile& file, float added, float mean = 0, uint64_t seed = 7) {
  Random random(seed);
  const int hidden = static_cast<int>(file.tensors.at("pose.trunk.1.bias").values.size());
  for (int h = 0; file.tensors.contains("pose.head." + std::to_string(h) + ".bias"); ++h) {
    const std::string head = "pose.head." + std::to_string(h);
    const std::string reduce = "pose.reduce." + std::to_string(h);
    Tensor weights = random_tensor({2 * hidden, hidden}, added, random);
    for (int i = 0; i < hidden * hidden; ++i) {
      weights.values[size_t(hidden) * hidden + i] = i % (hidden + 1) == 0 ? 1.0f : 0.0f;
    }
    file.tensors[reduce + ".weight"] = weights;
    file.tensors[reduce + ".bias"] = constant_tensor(hidden, -mean);
    const std::vector<float>& from = file.tensors.at(head + ".weight").values;
    std::vector<float>& bias = file.tensors.at(head + ".bias").values;
    for (size_t i = 0; i < from.size(); ++i) bias[i % bias.size()] += mean * from[i];
  }
}

// Makes a model of make_model() ask for this tempo, in all styles and on any motion.
inline void set_rate(TensorFile& file, double rate) {
  for (int h = 0; file.tensors.contains("timing.head." + std::to_string(h) + ".bias"); ++h) {
    const std::string head = "timing.head." + std::to_string(h);
    std::fill(file.tensors[head + ".weight"].values.begin(),
              file.tensors[head + ".weight"].values.end(), 0.0f);
    file.tensors[head + ".bias"].values = {static_cast<float>(std::log(rate))};
  }
}

// Gives a model of make_model() a predictor whose network adds numbers of this size, in metres, and
// which otherwise continues with constant velocity.
inline void add_predictor(TensorFile& file, float size = 0, uint64_t seed = 5) {
  constexpr int kNumbers = 66;
  Random random(seed);
  file.tensors["predict.mean"] = constant_tensor(kNumbers, 0);
  file.tensors["predict.scale"] = constant_tensor(kNumbers, 1);
  file.tensors["predict.linear"] = constant_tensor((kWindowPoses - 1) * kNumbers, 0);
  // The last change goes on as it is, but the root's velocity stays what it is.
  std::fill_n(file.tensors["predict.linear"].values.begin(), kNumbers - kRootFeatures, 1.0f);
  file.tensors["predict.trunk.0.weight"] =
      random_tensor({kWindowPoses * kNumbers, 8}, 0.05f, random);
  file.tensors["predict.trunk.0.bias"] = constant_tensor(8, 0);
  file.tensors["predict.head.0.weight"] = random_tensor({8, kNumbers}, size, random);
  file.tensors["predict.head.0.bias"] = constant_tensor(kNumbers, 0);
}

// How many activations the trunk of the pose network has.
inline int pose_activations(TensorFile& model) {
  int activations = 0;
  for (int l = 0; model.tensors.contains("pose.trunk." + std::to_string(l) + ".bias"); ++l) {
    const auto& bias = model.tensors["pose.trunk." + std::to_string(l) + ".bias"];
    activations += static_cast<int>(bias.values.size());
  }
  return activations;
}

// Gives a model (of any size) learnt style number `learnt`, the last of its styles, with weights of
// halves as panache learn writes them. The model learns to learn where it cannot yet.
inline void add_learnt(TensorFile& model, int learnt, const std::string& name,
                       const std::string& origin, uint64_t seed = 7) {
  constexpr int kDirections = 32;
  Random random(seed);
  const int activations = pose_activations(model);
  model.tensors.try_emplace("learn.mean", constant_tensor(activations, 0));
  model.tensors.try_emplace("learn.scale", constant_tensor(activations, 1));
  const std::string prefix = "learnt." + std::to_string(learnt) + ".";
  const int directions = std::min(kDirections, activations);
  model.tensors[prefix + "head.weight"] =
      random_tensor({activations, kLearntOutputs}, 0.1f, random);
  model.tensors[prefix + "head.bias"] = random_tensor({kLearntOutputs}, 0.1f, random);
  model.tensors[prefix + "mean"] = random_tensor({activations}, 0.1f, random);
  model.tensors[prefix + "gate.weight"] = random_tensor({activations, directions}, 0.1f, random);
  model.tensors[prefix + "gate.bias"] = random_tensor({directions}, 0.1f, random);
  model.tensors[prefix + "gate.worth"] = constant_tensor(directions, 1e-3f);
  model.tensors[prefix + "gate.rest"] = constant_tensor(1, 1e-3f);
  for (const char* part : {"head.weight", "gate.weight"}) {
    Tensor& weights = model.tensors[prefix + part];
    weights.half = true;
    for (float& w : weights.values) w = from_half(to_half(w));
  }
  model.metadata["styles"] += name + "\n";
  model.metadata["style_descriptions"] += "looks " + name + "\n";
  for (const char* list : {"style_groups", "style_sides", "style_words", "style_gesture_rates"}) {
    if (model.metadata.contains(list)) model.metadata[list] += "\n";
  }
  std::string& origins = model.metadata["style_origins"];
  const auto lines = [](const std::string& text) { return std::ranges::count(text, '\n'); };
  while (lines(origins) + 1 < lines(model.metadata["styles"])) origins += "\n";
  origins += origin + "\n";
}

// Gives a model (of any size) persons whose changes are visible and small.
inline void add_persons(TensorFile& model, int axes = 3, int units = 16, uint64_t seed = 11) {
  Random random(seed);
  const int activations = pose_activations(model);
  model.tensors["person.reduce.weight"] = random_tensor({activations, units}, 0.1f, random);
  model.tensors["person.reduce.bias"] = random_tensor({units}, 0.1f, random);
  model.tensors["person.head.weight"] =
      random_tensor({axes * (units + 1), kLearntOutputs}, 0.3f, random);
  model.tensors["person.head.bias"] = constant_tensor(kLearntOutputs, 0);
  std::string names;
  for (int a = 0; a < axes; ++a) names += (a ? "\naxis " : "axis ") + std::to_string(a + 1);
  model.metadata["person_axes"] = names;
}

}  // namespace panache::test
