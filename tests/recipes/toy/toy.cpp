// A third recipe, as small as one can be: the networks see joint positions and the style's
// strengths, and answer with how far everything above the hips is bent, and how deep the hips are.

#include <algorithm>

#include "recipes/recipe.h"

namespace panache {
namespace {

constexpr int kOutputs = 4;  // A rotation vector and a height.

bool is_above_hips(int joint) {
  while (joint > 0 && joint != index(HumanJoint::spine)) joint = kHumanParent[joint];
  return joint > 0;
}

int style_inputs(int styles) noexcept { return styles; }

void write_style_inputs(std::span<const float> strengths, std::span<float> out) noexcept {
  std::copy(strengths.begin(), strengths.end(), out.begin());
}

void write_target(const StyleDelta& change, const HumanPositions&,
                  std::span<const float, kRootFeatures>, std::span<float> out) {
  const Vec3 bend = change.rotations[index(HumanJoint::chest)];
  const std::array<float, kOutputs> numbers = {bend.x, bend.y, bend.z, change.hips_height};
  std::copy(numbers.begin(), numbers.end(), out.begin());
}

void mirror_target(std::span<float> target) {
  target[1] = -target[1];
  target[2] = -target[2];
}

StyleDelta to_change(std::span<const float> answer, const HumanPositions&,
                     std::span<const float, kRootFeatures>) noexcept {
  StyleDelta change;
  for (int j = 0; j < kHumanJoints; ++j) {
    if (is_above_hips(j)) change.rotations[j] = {answer[0], answer[1], answer[2]};
  }
  change.hips_height = answer[3];
  return change;
}

}  // namespace

const Recipe& toy_recipe() noexcept {
  static const Recipe recipe = {.name = "toy",
                                .summary = "one bend for all",
                                .layout = PoseLayout::positions,
                                .layout_text = "positions[63] ground_velocity_xz[2] turn_rate[1]",
                                .outputs = kOutputs,
                                .style_inputs = style_inputs,
                                .write_style_inputs = write_style_inputs,
                                .write_target = write_target,
                                .mirror_target = mirror_target,
                                .to_change = to_change,
                                .training = {.steps = 300,
                                             .neutral_samples = true,
                                             .batch = {.size = 32, .mirrored = true},
                                             .optimizer = {.learning_rate = 0.003f}}};
  return recipe;
}

}  // namespace panache
