#pragma once
// Numbers as people write them, the same on every machine and in every locale.

#include <string>
#include <string_view>

namespace panache {

// Largest magnitude of numbers in files: too small for the solar system in metres or millimetres,
// and no sum or square of such numbers overflows a float.
inline constexpr double kLargestNumber = 1e9;

// Appends `value` with exactly `decimals` (0 to 9) digits after the point, without an exponent and
// never as negative zero. Numbers are clamped to kLargestNumber; NaN is written as 0.
void append_fixed(std::string& out, double value, int decimals);

// The same as a string.
std::string with_decimals(double value, int decimals);

// Digits after the point of `number`; 0 if it has an exponent.
int decimals_of(std::string_view number);

}  // namespace panache
