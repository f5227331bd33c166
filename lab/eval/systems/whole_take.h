#pragma once
// Answers of systems that look at a whole take before they answer.

#include <vector>

#include "learn/take.h"
#include "style/change_source.h"

namespace panache {

class WholeTakeSource : public ChangeSource {
 public:
  // `changes`: of each frame of `take`, whose first is `begin` seconds of the clip; none where
  // nothing is changed. The feet are planted where the changed body plants them; the tempo stays.
  WholeTakeSource(const Take& take, double begin, std::vector<StyleDelta> changes);

  AskedChange ask(const Seen& seen) override;

 private:
  double begin_;
  std::vector<std::array<float, StyleDelta::kSize>> changes_;  // [frames]
  std::vector<FootContacts> contacts_;
};

}  // namespace panache
