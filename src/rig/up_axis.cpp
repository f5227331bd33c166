#include "rig/up_axis.h"

#include <cmath>

namespace panache {

std::optional<Quat> turn_up(std::string_view axis) {
  const float half = std::sqrt(0.5f);
  if (axis == "+X") return Quat{0, 0, half, half};
  if (axis == "-X") return Quat{0, 0, -half, half};
  if (axis == "+Y") return Quat{};
  if (axis == "-Y") return Quat{1, 0, 0, 0};
  if (axis == "+Z") return Quat{-half, 0, 0, half};
  if (axis == "-Z") return Quat{half, 0, 0, half};
  return std::nullopt;
}

}  // namespace panache
