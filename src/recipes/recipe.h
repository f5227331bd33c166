#pragma once
// Everything that distinguishes one way of styling with networks from another. Training, models,
// the live step and the evaluator read it here; each recipe is a folder next to this file.

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "pose/features.h"
#include "pose/style_delta.h"
#include "recipes/training_settings.h"

namespace panache {

inline int no_style_inputs(int) noexcept { return 0; }
inline void write_no_style_inputs(std::span<const float>, std::span<float>) noexcept {}

struct Recipe {
  const char* name;         // Also its folder's, and in its models' metadata.
  const char* summary;      // A few words for people.
  PoseLayout layout;        // How the networks see a pose,
  const char* layout_text;  // and how a model's metadata says so.
  int outputs;              // Outputs of the pose network.

  // How styles get into the networks. Either each style has its own last layer, a head, whose
  // output is weighted by the style's strength (the contact network has one more, for no style);
  bool style_heads = false;
  // or one layer serves all styles, and models have style inputs after the window: how many for a
  // number of styles, and their values for given strengths. Allocates nothing.
  int (*style_inputs)(int styles) noexcept = no_style_inputs;
  void (*write_style_inputs)(std::span<const float> strengths,
                             std::span<float> out) noexcept = write_no_style_inputs;
  // Whether styles can be learnt on its models, which then have a gate. Requires style heads, so
  // that the trunks do not see the styles, and a packed StyleDelta as output.
  bool learns_styles = false;

  // Writes the pose network's target for a style that makes this change of a body (body frame) with
  // these root features. out[outputs]
  void (*write_target)(const StyleDelta& change, const HumanPositions& body,
                       std::span<const float, kRootFeatures> root, std::span<float> out);
  // Mirrors left and right, in place. target[outputs]
  void (*mirror_target)(std::span<float> target);
  // The reverse of write_target(): the change that an output stands for. Allocates nothing.
  StyleDelta (*to_change)(std::span<const float> output, const HumanPositions& body,
                          std::span<const float, kRootFeatures> root) noexcept;
  // Scale of each network output. [outputs] If null, targets are normalised to mean 0 and deviation
  // 1, and models store that mean too.
  std::vector<float> (*output_scale)() = nullptr;

  TrainingSettings training;
};

// The table of recipes.

// All recipes, in the order of the table in recipe.cpp.
std::span<const Recipe* const> recipes() noexcept;
// The recipe of this name, or null.
const Recipe* find_recipe(std::string_view name) noexcept;
// The first in the table: the default for training.
const Recipe& default_recipe() noexcept;

// "panache or smith2019", for messages: all recipes, or those whose models can learn styles.
std::string recipe_names();
std::string learning_recipe_names();

}  // namespace panache
