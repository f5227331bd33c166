#pragma once
// The table of recipes.

#include <span>
#include <string>
#include <string_view>

#include "recipes/recipe.h"

namespace panache {

// All recipes, in the order of the table in recipes.cpp.
std::span<const Recipe* const> recipes() noexcept;
// The recipe of this name, or null.
const Recipe* find_recipe(std::string_view name) noexcept;
// The first in the table: the default for training.
const Recipe& default_recipe() noexcept;

// "panache or smith2019", for messages: all recipes, or those whose models can learn styles.
std::string recipe_names();
std::string learning_recipe_names();

}  // namespace panache
