// The recipe of Smith et al. 2019, as in the paper's slides, for comparison: the networks see
// rotations and a style vector, and output a whole pose; the change is the difference from the
// input.

#include <algorithm>
#include <cassert>

#include "pose/features.h"
#include "recipes/recipe.h"
#include "rig/canonical_body.h"

namespace panache {
namespace {

// The style vector: neutral first, with the remainder of the styles to 1, then the styles.
int style_inputs(int styles) noexcept { return styles + 1; }

void write_style_inputs(std::span<const float> strengths, std::span<float> out) noexcept {
  float neutral = 1;
  for (const float s : strengths) neutral -= s;
  out[0] = std::max(neutral, 0.0f);
  std::copy(strengths.begin(), strengths.end(), out.begin() + 1);
}

// The absolute pose: the input's, changed.
void write_target(const StyleDelta& change, const HumanPositions& body,
                  std::span<const float, kRootFeatures> root, std::span<float> out) {
  assert(out.size() == AbsolutePose::kSize);
  std::array<Quat, kHumanJoints> frames;
  canonical_frames(body, 0, frames);
  for (int j = 0; j < kHumanJoints; ++j) {
    frames[j] = exp_rotation(change.rotations[j]) * frames[j];
  }
  AbsolutePose pose;
  pose.rotations = to_local(frames);
  pose.hips_height = body[0].y + change.hips_height;
  pose.root = {root[kVelocityLeft] + change.velocity_left,
               root[kVelocityForward] + change.velocity_forward,
               root[kTurnRate] + change.turn_rate};
  pack(pose, out.first<AbsolutePose::kSize>());
}

void mirror_target(std::span<float> target) { mirror_pose(PoseLayout::rotations, target); }

StyleDelta to_change(std::span<const float> output, const HumanPositions& body,
                     std::span<const float, kRootFeatures> root) noexcept {
  assert(output.size() == AbsolutePose::kSize);
  const AbsolutePose pose = unpack_pose(output.first<AbsolutePose::kSize>());
  StyleDelta change;
  std::array<Quat, kHumanJoints> before, after;
  canonical_frames(body, 0, before);
  for (int j = 0; j < kHumanJoints; ++j) {
    const int parent = kHumanParent[j];
    after[j] = parent < 0 ? pose.rotations[j] : after[parent] * pose.rotations[j];
    change.rotations[j] = log_rotation(after[j] * conjugate(before[j]));
  }
  change.hips_height = pose.hips_height - body[0].y;
  change.velocity_left = pose.root[kVelocityLeft] - root[kVelocityLeft];
  change.velocity_forward = pose.root[kVelocityForward] - root[kVelocityForward];
  change.turn_rate = pose.root[kTurnRate] - root[kTurnRate];
  return change;
}

}  // namespace

const Recipe& smith2019_recipe() noexcept {
  static const Recipe recipe = {
      .name = "smith2019",
      .summary = "as in the paper's slides",
      .layout = PoseLayout::rotations,
      .layout_text = "rotations_6d[126] hips_height[1] ground_velocity_xz[2] turn_rate[1]",
      .outputs = AbsolutePose::kSize,
      .style_inputs = style_inputs,
      .write_style_inputs = write_style_inputs,
      .write_target = write_target,
      .mirror_target = mirror_target,
      .to_change = to_change,
      // The slides: Adam, learning rate 0.01, 20 epochs of 550,000 samples in batches of 64. They
      // do not give Adam's epsilon. With the usual 1e-8 this learning rate makes all three networks
      // collapse to the mean within 2,000 steps, whatever the activation; with 0.01 they learn.
      .training = {.steps = 20 * 550000 / 64,
                   .neutral_samples = true,
                   .batch = {.size = 64},
                   .optimizer = {.learning_rate = 0.01f, .epsilon = 0.01f},
                   .squared_tempo = true}};
  return recipe;
}

}  // namespace panache
