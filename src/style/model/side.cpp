#include "style/model/side.h"

namespace panache {
namespace {

// Calls visit(word) for each word between spaces.
template <class Visit>
void for_each_word(std::string_view text, Visit&& visit) {
  while (!text.empty()) {
    const size_t end = std::min(text.find(' '), text.size());
    visit(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
}

}  // namespace

Result<void> check_side_phrase(std::string_view phrase) {
  int sides = 0;
  for_each_word(phrase, [&](std::string_view word) { sides += word == "left" || word == "right"; });
  if (phrase.empty() || sides == 1) return {};
  return Error{"'" + std::string(phrase) +
               "'; expected a phrase with the word left or right in it once, such as 'left leg'"};
}

Result<void> check_has_sides(const Model& model) {
  if (model.recipe().style_heads) return {};
  return Error{std::string("the styles of a model of recipe ") + model.recipe().name +
               " have no sides, because they share their networks; expected a model in which each "
               "style has a head of its own"};
}

Result<float> find_side(const Model& model, int style, std::string_view word) {
  if (Result<void> good = check_has_sides(model); !good) return good.error();
  if (word == "captured") return 1.0f;
  if (word == "mirrored") return -1.0f;
  const StyleInfo& info = model.styles()[static_cast<size_t>(style)];
  const bool is_side = word == "left" || word == "right";
  if (is_side && !info.side.empty()) {
    bool same = false;
    for_each_word(info.side, [&](std::string_view other) { same = same || other == word; });
    return same ? 1.0f : -1.0f;
  }
  const std::string rest = "captured, mirrored or a number from -1 to 1";
  if (is_side) {
    return Error{"the model does not say which side style '" + info.name +
                 "' was captured on, so '" + std::string(word) + "' is unknown; expected " + rest};
  }
  return Error{"unknown side '" + std::string(word) + "' of style '" + info.name + "'; expected " +
               (info.side.empty() ? "" : "left, right, ") + rest};
}

}  // namespace panache
