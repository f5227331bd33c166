#include "recipes/recipe.h"

#include <vector>

#include "base/text.h"

// The table. A recipe called NAME is a folder of that name which defines NAME_recipe(), and one
// line here.
// clang-format off
#define PANACHE_RECIPES(recipe) \
  recipe(panache) \
  recipe(smith2019)
// clang-format on

namespace panache {

#define DECLARE_RECIPE(name) const Recipe& name##_recipe() noexcept;
PANACHE_RECIPES(DECLARE_RECIPE)
#undef DECLARE_RECIPE

std::span<const Recipe* const> recipes() noexcept {
#define RECIPE_ADDRESS(name) &name##_recipe(),
  static const Recipe* const all[] = {PANACHE_RECIPES(RECIPE_ADDRESS)};
#undef RECIPE_ADDRESS
  return all;
}

const Recipe* find_recipe(std::string_view name) noexcept {
  for (const Recipe* recipe : recipes()) {
    if (recipe->name == name) return recipe;
  }
  return nullptr;
}

const Recipe& default_recipe() noexcept { return *recipes().front(); }

std::string recipe_names() {
  std::vector<std::string> names;
  for (const Recipe* recipe : recipes()) names.push_back(recipe->name);
  return one_of(names);
}

std::string learning_recipe_names() {
  std::vector<std::string> names;
  for (const Recipe* recipe : recipes()) {
    if (recipe->learns_styles) names.push_back(recipe->name);
  }
  return one_of(names);
}

}  // namespace panache
