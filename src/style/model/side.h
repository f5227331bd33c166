#pragma once
// Sides of styles. A style that was captured from one performer has a side: a limp has a leg. Side
// 1 is as captured, -1 its mirror image, and 0 the symmetric mean of both.

#include <string>
#include <string_view>

#include "base/result.h"
#include "style/model/model.h"

namespace panache {

// Whether `phrase` can be StyleInfo::side: empty, or words of which exactly one is "left" or
// "right", such as "left leg" or "to the right".
Result<void> check_side_phrase(std::string_view phrase);

// Fails with a message if the model's styles have no sides, because they share a last layer.
Result<void> check_has_sides(const Model& model);

// The side of a style that a word names: "captured" or "mirrored", or, if StyleInfo::side tells
// what was captured, "left" or "right". Fails for other words, and as check_has_sides(). `style` is
// an index in the model.
Result<float> find_side(const Model& model, int style, std::string_view word);

}  // namespace panache
