#pragma once
// Names of the up axis of a file.

#include <optional>
#include <string_view>

#include "base/quat.h"

namespace panache {

// The rotation that turns `axis` ("+X", "-Z", ...) to +y; nothing if the name is invalid.
std::optional<Quat> turn_up(std::string_view axis);

}  // namespace panache
