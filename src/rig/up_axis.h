#pragma once
// The axis of a file that points up, by its name.

#include <optional>
#include <string_view>

#include "base/quat.h"

namespace panache {

// The rotation that turns `axis` ("+X", "-Z", ...) to +y; nothing where it is no axis.
std::optional<Quat> turn_up(std::string_view axis);

}  // namespace panache
