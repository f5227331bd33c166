#pragma once
// Answers of systems that look at a whole take before they answer.

#include <vector>

#include "eval/systems/change_source.h"
#include "learn/take.h"

namespace panache {

class WholeTakeSource : public ChangeSource {
 public:
  // `changes`: of each frame of `take`; none where nothing is changed. The feet are planted where
  // the changed body plants them; the tempo stays.
  WholeTakeSource(const Take& take, std::vector<StyleDelta> changes);

  void reset() override {}
  AskedChange answer(std::span<const float> window, float frame, float seconds) override;

 private:
  std::vector<std::array<float, StyleDelta::kSize>> changes_;  // [frames]
  std::vector<FootContacts> contacts_;
};

}  // namespace panache
