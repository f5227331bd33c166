// A stylizer's memory as bytes, and back.

#include <algorithm>
#include <cassert>
#include <cstring>
#include <type_traits>
#include <vector>

#include "style/stylizer.h"

namespace panache {
namespace {

// Fowler, Noll and Vo's hash (FNV-1a): tells a damaged state from a whole one.
uint64_t hash_of(std::span<const std::byte> bytes) {
  uint64_t hash = 0xcbf29ce484222325;
  for (const std::byte b : bytes) hash = (hash ^ static_cast<uint64_t>(b)) * 0x100000001b3;
  return hash;
}

template <class T>
std::span<std::byte> bytes_of(std::vector<T>& numbers) {
  return std::as_writable_bytes(std::span(numbers));
}
template <class T>
std::span<const std::byte> bytes_of(const std::vector<T>& numbers) {
  return std::as_bytes(std::span(numbers));
}
template <class T>
auto bytes_of(T& value) {
  static_assert(std::is_trivially_copyable_v<T>);
  if constexpr (std::is_const_v<T>) {
    return std::as_bytes(std::span(&value, 1));
  } else {
    return std::as_writable_bytes(std::span(&value, 1));
  }
}

}  // namespace

template <class Self, class Visit>
void Stylizer::visit_state(Self& self, Visit&& visit) {
  visit(self.rotations_), visit(self.translations_), visit(self.window_), visit(self.strengths_);
  visit(self.amount_), visit(self.started_), visit(self.time_), visit(self.body_);
  visit(self.ground_), visit(self.last_ground_), visit(self.seen_), visit(self.numbers_);
  visit(self.log_rate_), visit(self.drift_), visit(self.sway_), visit(self.turn_);
  visit(self.change_);
  Rig::visit_state(self.rig_, visit);
  StyleNetworks::visit_state(self.networks_, visit);
  PoseHistory::visit_state(self.history_, visit);
  FootLock::visit_state(self.foot_lock_, visit);
}

size_t Stylizer::state_size() const noexcept {
  size_t size = sizeof(uint64_t);
  visit_state(*this, [&](const auto& member) { size += bytes_of(member).size(); });
  return size;
}

void Stylizer::save(std::span<std::byte> out) const noexcept {
  assert(out.size() == state_size());
  std::byte* to = out.data() + sizeof(uint64_t);
  visit_state(*this, [&](const auto& member) {
    const std::span<const std::byte> bytes = bytes_of(member);
    std::memcpy(to, bytes.data(), bytes.size());
    to += bytes.size();
  });
  const uint64_t hash = hash_of(out.subspan(sizeof(uint64_t)));
  std::memcpy(out.data(), &hash, sizeof hash);
}

bool Stylizer::restore(std::span<const std::byte> in) noexcept {
  if (in.size() != state_size()) return false;
  uint64_t hash = 0;
  std::memcpy(&hash, in.data(), sizeof hash);
  if (hash != hash_of(in.subspan(sizeof hash))) return false;
  const std::byte* from = in.data() + sizeof hash;
  visit_state(*this, [&](auto& member) {
    const std::span<std::byte> bytes = bytes_of(member);
    std::memcpy(bytes.data(), from, bytes.size());
    from += bytes.size();
  });
  return true;
}

}  // namespace panache
