#pragma once
// The recipes that tests call by name.

#include "recipes/recipe.h"

namespace panache::test {

inline const Recipe& kPanache = *find_recipe("panache");
inline const Recipe& kSmith2019 = *find_recipe("smith2019");

}  // namespace panache::test
