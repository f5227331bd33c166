#pragma once
// Learnt styles of random numbers, for tests that need some and no particular ones.

#include <string>

#include "make_model.h"

namespace panache::test {

// Gives a model (of any size) learnt style number `learnt`, the last of its styles, with weights of
// halves as panache learn writes them. The model learns to learn where it cannot yet.
inline void add_learnt(TensorFile& model, int learnt, const std::string& name,
                       const std::string& origin, uint64_t seed = 7) {
  constexpr int kDirections = 32;
  Random random(seed);
  int activations = 0;
  for (int l = 0; model.tensors.contains("pose.trunk." + std::to_string(l) + ".bias"); ++l) {
    const auto& bias = model.tensors["pose.trunk." + std::to_string(l) + ".bias"];
    activations += static_cast<int>(bias.values.size());
  }
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

}  // namespace panache::test
