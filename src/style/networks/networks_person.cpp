// The person in the answer of the networks.

#include <algorithm>

#include "base/easing.h"
#include "style/networks/networks_scratch.h"

namespace panache {

void StyleNetworks::set_person(std::span<const float> numbers) noexcept {
  is_person_ = false;
  if (!model_->persons()) return;
  for (size_t a = 0; a < model_->persons()->axes(); ++a) {
    person_[a] = numbers[a];
    is_person_ = is_person_ || numbers[a] != 0;
  }
}

void StyleNetworks::ease_person(const PersonNumbers& numbers, float gain) noexcept {
  constexpr float kNear = 1e-4f;
  PersonNumbers eased = person_;
  for (size_t a = 0; a < eased.size(); ++a) approach(eased[a], numbers[a], gain, kNear);
  set_person(eased);
}

void StyleNetworks::add_person(std::span<const Pass> passes, std::span<const float> scratch,
                               ScratchArena& arena) noexcept {
  const Model& m = *passes.front().networks->model_;
  if (!m.persons()) return;
  const PersonSpace& space = *m.persons();
  // A person is not mirrored: people have a side.
  const auto has_person = [](const Pass& pass) {
    return pass.half == Half::captured && pass.networks->is_person_;
  };
  // The characters with a person share the reading of its weights.
  std::array<size_t, kRowsAtOnce> who;
  size_t rows = 0;
  for (size_t p = 0; p < passes.size(); ++p) {
    if (has_person(passes[p])) who[rows++] = p;
  }
  if (rows == 0) return;
  ScratchArena room = arena;
  const size_t units = space.units(), inputs = space.head().inputs();
  const Rows<float> reduced = room.rows(rows, space.reduction().width());
  {
    ScratchArena rest = room;
    const size_t count = m.activation_count();
    const Rows<float> activations = rest.rows(rows, count);
    for (size_t k = 0; k < rows; ++k) {
      m.trunks_.all_layers(Model::kPose, who[k], passes.size(), scratch,
                           {activations.row(k), count});
    }
    space.reduction().forward(Rows<const float>(activations), reduced);
  }
  const Rows<float> products = room.rows(rows, inputs);
  for (size_t k = 0; k < rows; ++k) {
    const StyleNetworks& self = *passes[who[k]].networks;
    const float open = memory(passes[who[k]]).gate;
    float* out = products.row(k);
    for (size_t a = 0; a < space.axes(); ++a) {
      const float number = self.person_[a];
      for (size_t i = 0; i < units; ++i) *out++ = number * open * reduced.row(k)[i];
      *out++ = number;
    }
  }
  const Rows<float> answers = room.rows(rows, space.head().width());
  space.head().forward(Rows<const float>(products), answers);
  constexpr int kChange = StyleDelta::kSize;
  for (size_t k = 0; k < rows; ++k) {
    HalfMemory& half = memory(passes[who[k]]);
    const std::span<const float> answer(answers.row(k), kLearntOutputs);
    add_scaled(1, answer.first<kChange>(), half.pose);
    add_scaled(1, answer.subspan<kChange, 1>(), half.timing);
    add_scaled(1, answer.subspan<kChange + 1, 2>(), half.contact);
  }
}

}  // namespace panache
