#include "rig/file_space.h"

#include <array>
#include <cmath>

namespace panache {
namespace {

// CMU's lengths are inches times 0.45.
constexpr std::array<UsualUnit, 6> kUnits = {{{"metres", 1},
                                              {"feet", 0.3048},
                                              {"CMU units", 0.0254 / 0.45},
                                              {"inches", 0.0254},
                                              {"centimetres", 0.01},
                                              {"millimetres", 0.001}}};

}  // namespace

std::optional<UsualUnit> usual_unit(double metres) {
  // The scale is that of canonical legs, and people differ: 1.35 is half-way between the closest
  // neighbours in this list.
  for (const UsualUnit& unit : kUnits) {
    if (std::abs(std::log(metres / unit.metres)) < std::log(1.35)) return unit;
  }
  return std::nullopt;
}

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
