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

// Steps every member by `seconds`, with results identical to separate steps. Fastest if characters
// of one model are adjacent. A character that occurs twice is stepped twice, in order. A member's
// `out` may be the same as its `in`, but must not overlap another's. Allocates nothing, never
// fails; uses about 200 KB of stack.
void step_crowd(std::span<const CrowdMember> members, double seconds) noexcept;

}  // namespace panache
