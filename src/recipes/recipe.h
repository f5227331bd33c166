#pragma once
// All that tells one way of styling with networks from another. Training, models, the live step and
// the judge read it here; each recipe is a folder beside this file.

#include <span>
#include <vector>

#include "pose/features.h"
#include "pose/style_delta.h"
#include "recipes/training_settings.h"

namespace panache {

inline int no_style_inputs(int) noexcept { return 0; }
inline void write_no_style_inputs(std::span<const float>, std::span<float>) noexcept {}

struct Recipe {
  const char* name;         // Of its folder, and in the metadata of its models.
  const char* summary;      // A few words for people.
  PoseLayout layout;        // How the networks see a pose,
  const char* layout_text;  // and how a model's metadata says so.
  int outputs;              // Numbers that the pose network answers with.

  // How a style gets into the networks. Either each style has a last layer of its own, a head,
  // whose answer counts by the style's strength (and the contact network one more, of no style);
  bool style_heads = false;
  // or one layer answers for all styles, and a model of so many styles sees so many numbers of them
  // behind the window: these, at these strengths. Allocates nothing.
  int (*style_inputs)(int styles) noexcept = no_style_inputs;
  void (*write_style_inputs)(std::span<const float> strengths,
                             std::span<float> out) noexcept = write_no_style_inputs;
  // Styles can be learnt on its models, which have a gate. Only where styles have heads, so that
  // the trunks do not see them, and the answer is a packed StyleDelta.
  bool learns_styles = false;

  // Writes what the pose network should answer where a style makes this change of a body (body
  // frame) with these root features. out[outputs]
  void (*write_target)(const StyleDelta& change, const HumanPositions& body,
                       std::span<const float, kRootFeatures> root, std::span<float> out);
  // Left for right, in place. target[outputs]
  void (*mirror_target)(std::span<float> target);
  // The reverse of write_target(): the change that an answer is. Allocates nothing.
  StyleDelta (*to_change)(std::span<const float> answer, const HumanPositions& body,
                          std::span<const float, kRootFeatures> root) noexcept;
  // Scale of each network output. [outputs] Where it is null,
  // targets are brought to mean 0 and deviation 1, and models keep that mean besides.
  std::vector<float> (*output_scale)() = nullptr;

  TrainingSettings training;
};

}  // namespace panache
