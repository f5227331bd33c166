#include "style/crowd.h"

#include <algorithm>
#include <array>

namespace panache {
namespace {

// How many of the first members can be stepped at once: different characters of one model.
size_t count_together(std::span<const CrowdMember> members) {
  const size_t most = std::min(members.size(), kRowsAtOnce);
  for (size_t i = 1; i < most; ++i) {
    const Stylizer* character = members[i].character;
    const bool seen = std::any_of(members.begin(), members.begin() + i,
                                  [&](const CrowdMember& m) { return m.character == character; });
    if (seen || &character->model() != &members[0].character->model()) return i;
  }
  return most;
}

}  // namespace

void step_crowd(std::span<const CrowdMember> members, double seconds) noexcept {
  while (!members.empty()) {
    const size_t count = count_together(members);
    std::array<StepTime, kRowsAtOnce> times;
    std::array<StyleNetworks::Pass, kRowsAtOnce> passes;
    for (size_t i = 0; i < count; ++i) {
      const auto& [character, in, strengths, out] = members[i];
      // By its turn the next one's past has come from a far cache.
      if (i + 1 < members.size()) members[i + 1].character->window_.fetch(seconds);
      times[i] = character->take_in(in, strengths, seconds, seconds, nullptr);
      passes[i] = character->pass(times[i]);
    }
    StyleNetworks::forward_all(std::span(passes).first(count));
    for (size_t i = 0; i < count; ++i) {
      members[i].character->give_out(times[i], members[i].out, nullptr);
    }
    members = members.subspan(count);
  }
}

}  // namespace panache
