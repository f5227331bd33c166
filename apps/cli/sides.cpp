#include "sides.h"

#include <algorithm>
#include <optional>

#include "clip/text_cursor.h"
#include "messages.h"
#include "style/model/model.h"

namespace panache::cli {
namespace {

// The style and the side of "limping=left".
struct TypedSide {
  int style;
  std::string side;
};
Result<TypedSide> split(const std::string& text, const Model& model) {
  const size_t equals = text.find('=');
  if (equals == std::string::npos) {
    return Error{"--side " + text + ": expected a style and a side, as in '" + text + "=mirrored'"};
  }
  const Result<int> style = model.find_style_by_any_name(text.substr(0, equals));
  if (!style) return located("--side " + text, style.error());
  return TypedSide{*style, text.substr(equals + 1)};
}

}  // namespace

void add_side_option(CLI::App& verb, std::vector<std::string>& texts) {
  add_option(verb, "--side SIDE", texts,
             "NAME=left, right, captured, mirrored or a number from 1\n"
             "(as captured, the default) to -1 (mirrored): the side of\n"
             "a style, such as the leg of a limp. panache styles names\n"
             "the captured one. One --side per style")
      ->allow_extra_args(false);
}

Result<float> read_side(const Model& model, int style, const std::string& text) {
  if (const std::optional<double> number = parse_number(text)) {
    if (Result<void> good = check_has_sides(model); !good) return good.error();
    if (*number >= -1 && *number <= 1) return static_cast<float>(*number);
    return Error{"expected a side from -1 to 1, found " + panache::quoted(text)};
  }
  return find_side(model, style, text);
}

Result<std::vector<float>> parse_sides(const std::vector<std::string>& texts, const Model& model) {
  if (texts.empty()) return std::vector<float>();
  std::vector<float> sides(model.styles().size(), 1.0f);
  std::vector<bool> given(sides.size());
  for (const std::string& text : texts) {
    const Result<TypedSide> typed = split(text, model);
    if (!typed) return typed.error();
    const auto style = static_cast<size_t>(typed->style);
    if (given[style]) {
      return Error{"--side " + text + ": this style has a side already; expected each style once"};
    }
    given[style] = true;
    const Result<float> side = read_side(model, typed->style, typed->side);
    if (!side) return located("--side " + text, side.error());
    sides[style] = *side;
  }
  return sides;
}

Result<void> check_sides_used(const std::vector<std::string>& texts,
                              const std::vector<StrengthWish>& wishes, const Model& model) {
  for (const std::string& text : texts) {
    const Result<TypedSide> typed = split(text, model);
    if (!typed) return typed.error();
    const bool used = std::ranges::any_of(
        wishes, [&](const StrengthWish& wish) { return wish.track.style == typed->style; });
    if (used) continue;
    const std::string& name = model.styles()[static_cast<size_t>(typed->style)].name;
    return Error{"--side " + text + ": style '" + name + "' is not put on; add --style " + name +
                 "=1, or leave the side out"};
  }
  return {};
}

float side_of(const std::vector<float>& sides, int style) {
  return sides.empty() ? 1.0f : sides[static_cast<size_t>(style)];
}

std::string describe_side(float side) {
  if (side == 1) return "";
  return side == -1 ? " mirrored" : " side " + brief(static_cast<double>(side));
}

}  // namespace panache::cli
