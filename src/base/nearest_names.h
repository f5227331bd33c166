#pragma once
// Suggestions for a name that was mistyped.

#include <string>
#include <string_view>
#include <vector>

namespace panache {

// At most `count` of `names` that `wanted` probably means, most likely first: at most a third of
// the letters are wrong, or one name is a prefix of the other. Ignores case.
std::vector<std::string> nearest_names(std::string_view wanted,
                                       const std::vector<std::string>& names, size_t count = 3);

// "is a", "are a and b", "are a, b and c": continues "the nearest ".
std::string is_or_are(const std::vector<std::string>& names);

}  // namespace panache
