#include "eval/systems/whole_take.h"

#include <algorithm>
#include <cmath>

#include "style/stages/shaping.h"

namespace panache {

WholeTakeSource::WholeTakeSource(const Take& take, double begin, std::vector<StyleDelta> changes)
    : begin_(begin), changes_(changes.size()) {
  std::vector<HumanPositions> world;
  for (size_t f = 0; f < changes.size(); ++f) {
    pack(changes[f], changes_[f]);
    world.push_back(to_world(change_body(take.body[f], changes[f]), take.root[f]));
  }
  contacts_ = detect_contacts(world, kTakeRate);
}

AskedChange WholeTakeSource::ask(const SourceInput& input) {
  AskedChange out;
  if (changes_.empty()) return out;
  const float last = static_cast<float>(changes_.size() - 1);
  const float at =
      std::clamp(static_cast<float>((input.time.clip - begin_) * kTakeRate), 0.0f, last);
  const size_t a = static_cast<size_t>(at), b = std::min(a + 1, changes_.size() - 1);
  const float t = at - static_cast<float>(a);
  std::array<float, StyleDelta::kSize> change;
  for (size_t n = 0; n < change.size(); ++n) {
    change[n] = std::lerp(changes_[a][n], changes_[b][n], t);
  }
  out.delta = unpack(change);
  const FootContacts& planted = contacts_[t < 0.5f ? a : b];
  for (size_t f = 0; f < kFeet; ++f) out.contacts[f] = planted[f] ? 1.0f : 0.0f;
  return out;
}

}  // namespace panache
