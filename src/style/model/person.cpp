#include "style/model/person.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "base/random.h"
#include "style/model/model.h"

namespace panache {
namespace {

constexpr const char* kReduce = "person.reduce";
constexpr const char* kHead = "person.head";
constexpr const char* kNames = "person_axes";

// The 95 % quantile of the squared length of standard normal vectors (chi-squared), by their size.
constexpr std::array<float, kMaxPersonAxes> kNearly = {3.841f,  5.991f,  7.815f,  9.488f,  11.070f,
                                                       12.592f, 14.067f, 15.507f, 16.919f, 18.307f};

}  // namespace

bool PersonSpace::is_in(const TensorFile& file) {
  return file.tensors.contains(std::string(kHead) + ".weight");
}

Result<PersonSpace> PersonSpace::read(const TensorFile& file, int activations,
                                      std::span<const float> output_scale,
                                      const std::string& name) {
  PersonSpace space;
  const auto names = file.metadata.find(kNames);
  if (names != file.metadata.end()) space.names_ = split_lines(names->second);
  const size_t axes = space.names_.size();
  if (axes == 0 || axes > kMaxPersonAxes) {
    return Error{name + ": metadata '" + kNames + "' has " + std::to_string(axes) +
                 " lines; expected 1 to " + std::to_string(kMaxPersonAxes) +
                 ", one for each axis of persons"};
  }
  const Result<DenseLayer> reduce = read_layer(file, kReduce, activations, -1, name);
  if (!reduce) return reduce.error();
  if (reduce->outputs > static_cast<int>(kMaxPersonUnits)) {
    return Error{name + ": layer '" + kReduce + "' has " + std::to_string(reduce->outputs) +
                 " units; expected at most " + std::to_string(kMaxPersonUnits)};
  }
  space.units_ = static_cast<size_t>(reduce->outputs);
  const Result<DenseLayer> head =
      read_layer(file, kHead, static_cast<int>(axes * (space.units_ + 1)), kLearntOutputs, name);
  if (!head) return head.error();
  for (const float bias : head->bias) {
    if (bias != 0) {
      return Error{name + ": tensor '" + kHead +
                   ".bias' must be zero, so that the mean person changes nothing"};
    }
  }
  for (size_t a = 0; a < axes; ++a) {
    const float* mean = &head->weights[(a * (space.units_ + 1) + space.units_) * kLearntOutputs];
    std::array<float, StyleDelta::kSize> change;
    for (size_t i = 0; i < change.size(); ++i) change[i] = mean[i] * output_scale[i];
    space.stances_.push_back(stance_of(unpack(change)));
  }
  space.reduction_ = PackedLayer(*reduce);
  space.head_ = PackedLayer(*head);
  return space;
}

Stance PersonSpace::stance(std::span<const float> numbers) const noexcept {
  Stance sum;
  for (size_t a = 0; a < stances_.size(); ++a) {
    sum.heel += numbers[a] * stances_[a].heel;
    for (size_t f = 0; f < kFeet; ++f) sum.turn[f] += numbers[a] * stances_[a].turn[f];
  }
  return sum;
}

void draw_person(uint32_t seed, std::span<float> out) noexcept {
  if (out.empty()) return;
  // Streams of neighbouring seeds are the same one, a number later.
  Random random(Random(seed).bits());
  for (;;) {
    float square = 0;
    for (float& number : out) {
      // A sum of four has thinner tails than people: four of them are nearer to normal.
      number = 0;
      for (int part = 0; part < 4; ++part) number += random.normal() / 2;
      square += number * number;
    }
    if (square <= kNearly[std::min(out.size(), kMaxPersonAxes) - 1]) return;
  }
}

PersonNumbers person_of_seed(const Model& model, uint32_t seed, float amount) noexcept {
  PersonNumbers person{};
  if (!model.persons()) return person;
  draw_person(seed, std::span(person).first(model.persons()->axes()));
  for (float& number : person) number *= amount;
  return person;
}

uint32_t person_seed(std::string_view word) noexcept {
  uint32_t seed = 0;
  const char* const end = word.data() + word.size();
  if (const auto read = std::from_chars(word.data(), end, seed);
      read.ec == std::errc() && read.ptr == end) {
    return seed;
  }
  // Fowler, Noll and Vo's hash (FNV-1a).
  uint32_t hash = 0x811c9dc5;
  for (const char c : word) hash = (hash ^ static_cast<unsigned char>(c)) * 0x01000193;
  return hash;
}

Result<void> check_has_persons(const Model& model) {
  if (model.persons()) return {};
  return Error{
      "the model has no persons; expected one with tensors 'person.*', such as the one that "
      "is shipped"};
}

}  // namespace panache
