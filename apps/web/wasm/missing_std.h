#pragma once
// C++20 features that the library uses and Debian's Emscripten (3.1.6) lacks. Included before every
// file; empty with a newer Emscripten.

#include <algorithm>
#include <iterator>
#include <version>

#ifndef __cpp_lib_bit_cast
namespace std {
template <class To, class From>
constexpr To bit_cast(const From& value) noexcept {
  return __builtin_bit_cast(To, value);
}
}  // namespace std
#endif

#ifndef __cpp_lib_ranges
namespace std::ranges {
template <class Range, class Out>
constexpr Out copy(Range&& range, Out out) {
  return std::copy(std::begin(range), std::end(range), out);
}
template <class A, class B>
constexpr bool equal(A&& a, B&& b) {
  return std::equal(std::begin(a), std::end(a), std::begin(b), std::end(b));
}
template <class Range, class Test>
constexpr bool any_of(Range&& range, Test test) {
  return std::any_of(std::begin(range), std::end(range), test);
}
template <class Range, class Test>
constexpr bool all_of(Range&& range, Test test) {
  return std::all_of(std::begin(range), std::end(range), test);
}
template <class Range, class Value>
constexpr void fill(Range&& range, const Value& value) {
  std::fill(std::begin(range), std::end(range), value);
}
template <class Number>
struct minmax_result {
  Number min, max;
};
template <class Range>
constexpr auto minmax(Range&& range) {
  const auto [min, max] = std::minmax_element(std::begin(range), std::end(range));
  return minmax_result<std::iter_value_t<decltype(min)>>{*min, *max};
}
}  // namespace std::ranges
#endif
