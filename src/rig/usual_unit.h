#pragma once
// The units that motion files are in.

#include <optional>
#include <string_view>

namespace panache {

struct UsualUnit {
  std::string_view name;  // "metres", "CMU units", ...
  double metres;
};

// The unit that is meant by a scale that was inferred from the length of legs (metres per file
// unit, for legs as long as the canonical body's); nothing where none comes close.
std::optional<UsualUnit> usual_unit(double metres);

}  // namespace panache
