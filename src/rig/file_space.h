#pragma once
// The space of a motion file: its up axis and its unit.

#include <optional>
#include <string_view>

#include "base/quat.h"

namespace panache {

struct UsualUnit {
  std::string_view name;  // "metres", "CMU units", ...
  double metres;
};

// The likely unit for a scale inferred from the length of the legs (metres per file unit, for
// canonical legs); nothing if none is close.
std::optional<UsualUnit> usual_unit(double metres);

// The rotation that turns `axis` ("+X", "-Z", ...) to +y; nothing if the name is invalid.
std::optional<Quat> turn_up(std::string_view axis);

}  // namespace panache
