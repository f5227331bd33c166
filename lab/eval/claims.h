#pragma once
// What a style's description says that one sees, as movements that can be measured.

#include <string>
#include <string_view>
#include <vector>

#include "eval/arrival.h"

namespace panache {

struct Claim {
  std::string_view words;  // In a description.
  size_t trait;            // See kMovementTraits.
  bool more;               // More of it than in a neutral walk, or less.
};

// The claims of a description.
std::vector<Claim> claims_of(std::string_view description);

// The words of a description that do not show on the walker's walks: real takes do not differ in
// this movement, or differ the other way, or less than 0.7 of the difference arrives; or the steps
// a second are those of a usual walk.
std::vector<std::string> unshown(std::string_view description, const StyleArrival& style);

}  // namespace panache
