// A live stylizer's memory as bytes, and back: the stylizer's own, then that of its time.

#include <cassert>

#include "style/live_stylizer.h"
#include "style/state_bytes.h"

namespace panache {

template <class Self, class Visit>
void LiveStylizer::visit_state(Self& self, Visit&& visit) {
  PlayHead::visit_state(self.head_, visit);
  visit(self.skipped_);
  auto& t = *self.timed_;
  Rig::visit_state(t.reader, visit);
  InputRing::visit_state(t.ring, visit);
  if (t.foresight) Foresight::visit_state(*t.foresight, visit);
  visit(t.ahead), visit(t.now), visit(t.ground), visit(t.rotations), visit(t.translations),
      visit(t.time);
  visit(t.searched), visit(t.started), visit(t.glue), visit(t.old_glue), visit(t.old_ahead);
  visit(t.blended);
}

size_t LiveStylizer::state_size() const noexcept {
  const size_t own =
      timed_ ? state_bytes([this](auto&& visit) { visit_state(*this, visit); }) : size_t{0};
  return stylizer_.state_size() + own;
}

void LiveStylizer::save(std::span<std::byte> out) const noexcept {
  assert(out.size() == state_size());
  stylizer_.save(out.first(stylizer_.state_size()));
  if (!timed_) return;
  write_state(out.subspan(stylizer_.state_size()),
              [this](auto&& visit) { visit_state(*this, visit); });
}

bool LiveStylizer::restore(std::span<const std::byte> in) noexcept {
  if (in.size() != state_size()) return false;
  const auto own = in.subspan(stylizer_.state_size());
  if (timed_ && !is_whole_state(own)) return false;
  if (!stylizer_.restore(in.first(stylizer_.state_size()))) return false;
  if (timed_) read_state(own, [this](auto&& visit) { visit_state(*this, visit); });
  return true;
}

}  // namespace panache
