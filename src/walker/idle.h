#pragma once
// The idle motion of a standing person.

#include "walker/gait.h"

namespace panache {

// Adds breath, a wandering gaze and, as far as the body stands (`standing`, 0 to 1), weight going
// from foot to foot. A function of time alone.
void add_idle(double seconds, float standing, Channels& channels) noexcept;

}  // namespace panache
