#pragma once
// Suggestions for a name that was mistyped.

#include <string>
#include <string_view>
#include <vector>

namespace panache {

// Those of `names` that `wanted` is likely to mean, the likeliest first, at most `count`: a third
// of the letters or fewer are wrong, or one name begins with the other. Case does not matter.
std::vector<std::string> nearest_names(std::string_view wanted,
                                       const std::vector<std::string>& names, size_t count = 3);

// "is a", "are a and b", "are a, b and c": as it goes on from "the nearest ".
std::string is_or_are(const std::vector<std::string>& names);

}  // namespace panache
