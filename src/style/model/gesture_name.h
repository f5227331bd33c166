#pragma once
// What a gesture does, in words.

#include <span>
#include <string>
#include <vector>

namespace panache {

struct GesturePose;

// The movements of a gesture with these control points, the largest first: "glances over the left
// shoulder", "throws both arms up". At least one; small ones are left out.
std::vector<std::string> movements_of(const std::vector<GesturePose>& points);

// A name for each of a style's gestures, given their movements: the largest movement, and more of
// them where names would be equal. Gestures with the same movements are numbered.
std::vector<std::string> distinct_names(std::span<const std::vector<std::string>> gestures);

}  // namespace panache
