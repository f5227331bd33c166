#pragma once
// Many characters stepped together: the networks' weights are read once for several of them.

#include <span>

#include "style/stylizer.h"

namespace panache {

// One character's part in a step of many; the arguments of Stylizer::step().
struct CrowdMember {
  Stylizer* character;
  ConstPose in;
  std::span<const float> strengths;
  Pose out;
};

// Steps every member by `seconds`, with the bits that each gets alone. Fastest where characters of
// one model stand side by side. A character that comes twice is stepped twice, in order. A member's
// `out` may be its own `in`, but no part of another's. Allocates nothing, never fails; works in
// about 200 KB of the stack.
void step_crowd(std::span<const CrowdMember> members, double seconds) noexcept;

}  // namespace panache
