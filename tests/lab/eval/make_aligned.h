#pragma once
// Test takes whose alignment is known, and models that answer with a constant.

#include <string>
#include <vector>

#include "eval/aligned_takes.h"
#include "eval/systems/model_system.h"
#include "learn/make_takes.h"
#include "make_model.h"

namespace panache::test {

// A neutral walk, and the same walk bent forward in the styles "old" and, half as much, "sad".
inline AlignedTakes bent_walks() {
  return AlignedTakes({walk_take("neutral", "walk", 150, 0), walk_take("old", "walk", 120, kBend),
                       walk_take("sad", "walk", 110, kBend / 2),
                       walk_take("old", "run", 110, kBend)});
}

inline ModelSystem as_system(std::shared_ptr<const Model> model) {
  return {"model", std::move(model)};
}

// A model of recipe panache with the style "old", which bends the body forward at the spine by
// `bend` radians, as all that is above the spine joint is turned; whatever the motion.
inline std::shared_ptr<const Model> bending_model(float bend) {
  TensorFile file = make_model({"old"});
  for (float& weight : file.tensors["pose.head.0.weight"].values) weight = 0;
  std::vector<float>& bias = file.tensors["pose.head.0.bias"].values;
  for (float& b : bias) b = 0;
  for (int j = index(HumanJoint::spine); j <= index(HumanJoint::right_hand); ++j) {
    bias[3 * j] = bend;
  }
  for (float& scale : file.tensors["output.scale"].values) scale = 1;
  return *Model::parse(format_safetensors(file), "bending");
}

// A model of recipe smith2019 with the style "old", which always answers with this pose of 130
// numbers.
inline std::shared_ptr<const Model> posing_model(const std::vector<float>& pose) {
  TensorFile file = make_model({"old"}, 1, test::kSmith2019);
  for (const char* name : {"pose.head.0.weight", "pose.head.0.bias"}) {
    for (float& value : file.tensors[name].values) value = 0;
  }
  file.tensors["output.mean"].values = pose;
  return *Model::parse(format_safetensors(file), "posing");
}

}  // namespace panache::test
