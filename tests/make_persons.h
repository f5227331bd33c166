#pragma once
// A space of persons of random numbers, for tests that need one and no particular one.

#include <string>

#include "make_model.h"

namespace panache::test {

// Gives a model (of any size) persons whose changes are visible and small.
inline void add_persons(TensorFile& model, int axes = 3, int units = 16, uint64_t seed = 11) {
  Random random(seed);
  int activations = 0;
  for (int l = 0; model.tensors.contains("pose.trunk." + std::to_string(l) + ".bias"); ++l) {
    const auto& bias = model.tensors["pose.trunk." + std::to_string(l) + ".bias"];
    activations += static_cast<int>(bias.values.size());
  }
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
