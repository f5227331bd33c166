#pragma once
// Changes of systems that process a whole take in advance.

#include <vector>

#include "learn/take.h"
#include "style/networks/change_source.h"

namespace panache {

class WholeTakeSource : public ChangeSource {
 public:
  // `changes`: for each frame of `take`, whose first is at `begin` seconds of the clip; empty if
  // nothing changes. The foot contacts are those of the changed body; the tempo stays.
  WholeTakeSource(const Take& take, double begin, std::vector<StyleDelta> changes);

  AskedChange ask(const SourceInput& input) override;

 private:
  double begin_;
  std::vector<std::array<float, StyleDelta::kSize>> changes_;  // [frames]
  std::vector<FootContacts> contacts_;
};

}  // namespace panache
