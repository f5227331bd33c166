#pragma once
// The units of motion files.

#include <optional>
#include <string_view>

namespace panache {

struct UsualUnit {
  std::string_view name;  // "metres", "CMU units", ...
  double metres;
};

// The likely unit for a scale inferred from the length of the legs (metres per file unit, for
// canonical legs); nothing if none is close.
std::optional<UsualUnit> usual_unit(double metres);

}  // namespace panache
