// Our own recipe: the networks see joint positions and output a change of the input; each style is
// a head on trunks that all styles share.

#include <algorithm>
#include <cassert>

#include "recipes/recipe.h"

namespace panache {
namespace {

std::span<float, StyleDelta::kSize> numbers_of(std::span<float> output) {
  assert(output.size() == StyleDelta::kSize);
  return output.first<StyleDelta::kSize>();
}

void write_target(const StyleDelta& change, const HumanPositions&,
                  std::span<const float, kRootFeatures>, std::span<float> out) {
  pack(change, numbers_of(out));
}

void mirror_target(std::span<float> target) {
  pack(mirrored(unpack(numbers_of(target))), numbers_of(target));
}

StyleDelta to_change(std::span<const float> output, const HumanPositions&,
                     std::span<const float, kRootFeatures>) noexcept {
  assert(output.size() == StyleDelta::kSize);
  return unpack(output.first<StyleDelta::kSize>());
}

// Units that give all parts of a change equal weight: 0.25 rad, 5 cm, 0.15 m/s, 0.6 rad/s.
std::vector<float> output_scale() {
  StyleDelta unit;
  unit.rotations.fill({0.25f, 0.25f, 0.25f});
  unit.hips_height = 0.05f;
  unit.velocity_left = unit.velocity_forward = 0.15f;
  unit.turn_rate = 0.6f;
  std::vector<float> scale(StyleDelta::kSize);
  pack(unit, numbers_of(scale));
  return scale;
}

}  // namespace

const Recipe& panache_recipe() noexcept {
  static const Recipe recipe = {.name = "panache",
                                .summary = "style heads and differences",
                                .layout = PoseLayout::positions,
                                .layout_text = "positions[63] ground_velocity_xz[2] turn_rate[1]",
                                .outputs = StyleDelta::kSize,
                                .style_heads = true,
                                .learns_styles = true,
                                .write_target = write_target,
                                .mirror_target = mirror_target,
                                .to_change = to_change,
                                .output_scale = output_scale,
                                .training = {.steps = 20000,
                                             .batch = {.size = 256,
                                                       .by_style = true,
                                                       .mirrored = false,
                                                       .disturbed = true,
                                                       .disturbance = kOtherTempos,
                                                       .input_clip = 3},
                                             .optimizer = {.learning_rate = 0.004f,
                                                           .one_cycle = true,
                                                           .weight_decay = 0.2f,
                                                           .dropout = 0.02f},
                                             .smoothness = 0.6f,
                                             .positions = 4,
                                             .guidance = {.sequences = 20},
                                             .heads = {.rank = 20},
                                             .predictor_steps = 6000}};
  return recipe;
}

}  // namespace panache
