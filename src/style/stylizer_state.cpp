// A stylizer's memory as bytes, and back.

#include <cassert>

#include "style/state_bytes.h"
#include "style/stylizer.h"

namespace panache {

template <class Self, class Visit>
void Stylizer::visit_state(Self& self, Visit&& visit) {
  visit(self.rotations_), visit(self.translations_), visit(self.window_), visit(self.strengths_);
  visit(self.amount_), visit(self.started_), visit(self.time_), visit(self.body_);
  visit(self.ground_), visit(self.last_ground_), visit(self.seen_), visit(self.numbers_);
  visit(self.log_rate_), visit(self.drift_), visit(self.sway_), visit(self.turn_);
  visit(self.lift_), visit(self.change_);
  Rig::visit_state(self.rig_, visit);
  StyleNetworks::visit_state(self.networks_, visit);
  PoseHistory::visit_state(self.history_, visit);
  FootLock::visit_state(self.foot_lock_, visit);
}

size_t Stylizer::state_size() const noexcept {
  return state_bytes([this](auto&& visit) { visit_state(*this, visit); });
}

void Stylizer::save(std::span<std::byte> out) const noexcept {
  assert(out.size() == state_size());
  write_state(out, [this](auto&& visit) { visit_state(*this, visit); });
}

bool Stylizer::restore(std::span<const std::byte> in) noexcept {
  if (in.size() != state_size() || !is_whole_state(in)) return false;
  read_state(in, [this](auto&& visit) { visit_state(*this, visit); });
  return true;
}

}  // namespace panache
