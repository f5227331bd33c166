#pragma once
// How a style sets its feet on the ground.

#include <array>

#include "pose/contacts.h"
#include "pose/style_delta.h"

namespace panache {

// A style's change of a standing foot; zero keeps it.
struct Stance {
  float heel = 0;                   // How far the heel is lifted about the toes, radians.
  std::array<float, kFeet> turn{};  // About +y, radians.
};

// `mean`: the style's mean change. Only styles on tiptoe lift heels: in other styles a small mean
// lift comes from their steps.
Stance stance_of(const StyleDelta& mean) noexcept;

}  // namespace panache
