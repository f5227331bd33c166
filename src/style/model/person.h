#pragma once
// Persons: how people differ in all that they do, as a few numbers. In the networks a person is one
// more style, whose head is the sum of a few axes' heads.

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "net/layer.h"
#include "net/safetensors.h"
#include "pose/style_delta.h"

namespace panache {

class Model;

// Limits for files, so that a step can work on the stack.
inline constexpr size_t kMaxPersonAxes = 10, kMaxPersonUnits = 48;

// The numbers of a person, one per axis; axes that a model lacks are 0. Real people are distributed
// like independent standard normal numbers, and 0 everywhere is the mean of them, which leaves
// motion unchanged.
using PersonNumbers = std::array<float, kMaxPersonAxes>;

// Numbers of a person are clamped to -kMaxPerson to kMaxPerson.
inline constexpr float kMaxPerson = 6;

// The axes of a model along which people differ. They share what they read: a few combinations of
// the activations of all layers of the pose trunk.
class PersonSpace {
 public:
  static bool is_in(const TensorFile& file);
  // Reads and checks the tensors `person.*` and the names in the metadata. `activations`: see
  // Model::activation_count(); `output_scale`: scale of each output of the pose network.
  static Result<PersonSpace> read(const TensorFile& file, int activations,
                                  std::span<const float> output_scale, const std::string& name);

  size_t axes() const { return names_.size(); }
  // What an axis changes most, "arm swing"; see docs/persons.md.
  const std::vector<std::string>& names() const { return names_; }

  // [activations][units]: zero on average over people.
  const PackedLayer& reduction() const { return reduction_; }
  // [axes * (units + 1)][kLearntOutputs]: for each axis its number times each unit, and its number
  // alone.
  const PackedLayer& head() const { return head_; }
  size_t units() const { return units_; }
  // How a person stands.
  Stance stance(std::span<const float> numbers) const noexcept;

 private:
  std::vector<std::string> names_;
  PackedLayer reduction_, head_;
  size_t units_ = 0;
  std::vector<Stance> stances_;  // [axes]
};

// The person of a seed, drawn as people are distributed, without the rarest twentieth. The same on
// every machine. out.size() = the number of axes.
void draw_person(uint32_t seed, std::span<float> out) noexcept;

// The largest amount of a person: 2 is twice as far from the mean person.
inline constexpr float kMaxVariety = 2;
// The numbers of a seed's person on a model, `amount` times as far from the mean person; 0 without
// persons.
PersonNumbers person_of_seed(const Model& model, uint32_t seed, float amount) noexcept;

// The seed of a word; of a whole number below 2^32, that number.
uint32_t person_seed(std::string_view word) noexcept;

// Fails with a message if a model has no persons.
Result<void> check_has_persons(const Model& model);

}  // namespace panache
