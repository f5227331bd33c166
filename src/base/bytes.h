#pragma once
// Numbers as bytes: a character's memory, saved and restored, and integers in binary files.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace panache {

// Characters with the same history save the same bytes: members are initialised and have no
// padding.

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

// Fowler, Noll and Vo's hash (FNV-1a): detects damaged states.
inline uint64_t hash_of(std::span<const std::byte> bytes) {
  uint64_t hash = 0xcbf29ce484222325;
  for (const std::byte b : bytes) hash = (hash ^ static_cast<uint64_t>(b)) * 0x100000001b3;
  return hash;
}

// A state consists of a hash of the rest and all members that `visit_all` visits, concatenated.
// `visit_all(visitor)` calls visitor(member) for each, or visitor(member, used) if only the first
// `used` bytes are meaningful: the others are saved as zeros.
template <class VisitAll>
size_t state_bytes(VisitAll&& visit_all) {
  size_t size = sizeof(uint64_t);
  visit_all([&](const auto& member, size_t = 0) { size += bytes_of(member).size(); });
  return size;
}
template <class VisitAll>
void write_state(std::span<std::byte> out, VisitAll&& visit_all) {
  std::byte* to = out.data() + sizeof(uint64_t);
  visit_all([&](const auto& member, size_t used = SIZE_MAX) {
    const std::span<const std::byte> bytes = bytes_of(member);
    used = std::min(used, bytes.size());
    to = std::copy_n(bytes.begin(), used, to);
    to = std::fill_n(to, bytes.size() - used, std::byte{});
  });
  const uint64_t hash = hash_of(out.subspan(sizeof(uint64_t)));
  std::memcpy(out.data(), &hash, sizeof hash);
}
// Whether `in`, of the right size, is what write_state() wrote.
inline bool is_whole_state(std::span<const std::byte> in) {
  uint64_t hash = 0;
  std::memcpy(&hash, in.data(), sizeof hash);
  return hash == hash_of(in.subspan(sizeof hash));
}
template <class VisitAll>
void read_state(std::span<const std::byte> in, VisitAll&& visit_all) {
  const std::byte* from = in.data() + sizeof(uint64_t);
  visit_all([&](auto& member, size_t = 0) {
    const std::span<std::byte> bytes = bytes_of(member);
    std::copy_n(from, bytes.size(), bytes.begin());
    from += bytes.size();
  });
}

// Little-endian integers in binary files.

// The integer in `bytes`, at most 8 of them.
inline uint64_t little_endian(std::string_view bytes) {
  uint64_t value = 0;
  for (size_t i = bytes.size(); i-- > 0;) value = value << 8 | static_cast<unsigned char>(bytes[i]);
  return value;
}

// The lowest `size` bytes of `value`.
inline void append_little_endian(uint64_t value, size_t size, std::string& out) {
  for (size_t i = 0; i < size; ++i) out += static_cast<char>(value >> (8 * i) & 0xff);
}

}  // namespace panache
