#include "style_options.h"

#include <algorithm>
#include <array>
#include <iterator>

#include "clip/text_cursor.h"
#include "model_path.h"
#include "program.h"
#include "style/model/model.h"

namespace panache::cli {
namespace {

std::optional<float> amount(const std::string& text) {
  double value = 0;
  if (!CLI::detail::lexical_cast(text, value)) return std::nullopt;
  if (!(value >= 0 && value <= static_cast<double>(Shape::kMax))) return std::nullopt;
  return static_cast<float>(value);
}

const std::string& name_of(const Removal& removal) {
  return removal.remover->styles()[static_cast<size_t>(removal.style)].name;
}

}  // namespace

void add_shape_options(CLI::App& verb, ShapeFlags& flags) {
  const auto add = [&](const char* name, float& value, const char* description) {
    add_option(verb, name, value, description)
        ->check(in_range(0, static_cast<double>(Shape::kMax)));
  };
  add("--posture AMOUNT", flags.shape.posture,
      "Amount of the slow part of the style: 0 to 2;\ndefault: 1");
  add("--dynamics AMOUNT", flags.shape.dynamics,
      "Amount of its movement and root motion: 0 to 2;\ndefault: 1");
  add_option(verb, "--timing TIMING", flags.timing,
             "Where the style's tempo is applied: where the feet step\n(steps, the default), "
             "everywhere (all) or nowhere (off:\nframe by frame); or its amount where they "
             "step: 0 to 2");
  add_option(verb, "--region REGION", flags.regions,
             "REGION=AMOUNT: amount of the style on legs, torso,\nleft_arm or right_arm, 0 to 2. "
             "One --region per\nregion")
      ->allow_extra_args(false);
  add_option(verb, "--contacts AMOUNT", flags.shape.hand_contacts,
             "How firmly hands keep what they touch: each other, the\nhead, hips or thighs; 0 to 1 "
             "(the default)")
      ->check(in_range(0, 1));
  add("--energy AMOUNT", flags.shape.energy,
      "The input's own movement of torso, head and arms: from\ncalm (0) to lively (2); default: 1, "
      "as it is");
  add_option(verb, "--gestures RATE", flags.gestures,
             "How often the styles make their gestures: 1 as often as\nthe performers (the "
             "default), 0 never, up to 10 times as\noften. panache styles lists them")
      ->check(in_range(0, static_cast<double>(GesturePlayer::kMaxOften)));
}

Result<void> read_shape(const ShapeFlags& flags, StylizerOptions& stylizer) {
  Shape shape = flags.shape;
  stylizer.tempo_everywhere = flags.timing == "all";
  const std::optional<float> timing = flags.timing == "steps" || flags.timing == "all" ? 1.0f
                                      : flags.timing == "off"                          ? 0.0f
                                                              : amount(flags.timing);
  if (!timing) {
    return Error{"--timing " + panache::quoted(flags.timing) +
                 ": expected steps, all, off or an amount of 0 to 2"};
  }
  shape.timing = *timing;
  std::array<bool, kRegions> given{};
  for (const std::string& text : flags.regions) {
    const size_t equals = text.find('=');
    const auto region = static_cast<size_t>(
        std::ranges::find(kRegionNames, text.substr(0, equals)) - std::begin(kRegionNames));
    if (equals == std::string::npos || region == kRegions) {
      return Error{"--region " + panache::quoted(text) +
                   ": expected legs, torso, left_arm or right_arm, '=' and an amount, such as "
                   "legs=0.5"};
    }
    const std::optional<float> value = amount(text.substr(equals + 1));
    if (!value) {
      return Error{"--region " + panache::quoted(text) + ": expected an amount of 0 to 2, found " +
                   panache::quoted(text.substr(equals + 1))};
    }
    if (given[region]) {
      return Error{std::string("--region ") + kRegionNames[region] + " is given twice"};
    }
    given[region] = true;
    shape.regions[region] = *value;
  }
  stylizer.shape = shape;
  stylizer.gesture_rate = flags.gestures;
  return {};
}

void add_removal_options(CLI::App& verb, RemovalFlags& flags) {
  CLI::Option* remove = add_option(verb, "--remove STYLE", flags.style,
                                   "The style that the input shows: it is taken off first");
  verb.add_flag("--neutral", flags.neutral, "Take whatever style the input shows off first")
      ->excludes(remove);
  add_option(verb, "--remover FILE", flags.remover,
             "Model that takes styles off; default: the one shipped");
}

std::optional<Removal> read_removal(const RemovalFlags& flags) {
  if (!flags.given()) {
    if (flags.remover.empty()) return std::nullopt;
    throw Failure{{"--remover: nothing is to be taken off; add --remove STYLE or --neutral"},
                  kBadUsage};
  }
  const std::string path =
      flags.remover.empty() ? need(find_shipped(kRemoverModel)) : flags.remover;
  const std::shared_ptr<const Model> remover = need(Model::load(path));
  if (!is_remover(*remover)) {
    throw Failure{{path + ": puts styles on; expected a model that takes them off"}, kBadInput};
  }
  const Result<int> style = find_removal(*remover, flags.style);
  if (!style) throw Failure{{"--remove: " + style.error().message}, kBadUsage};
  return Removal{remover, *style};
}

std::string describe(const Removal& removal) {
  return name_of(removal) == kAnyStyle ? "neutral" : name_of(removal) + " off";
}

Json removed_json(const std::optional<Removal>& removal) {
  return removal ? Json(name_of(*removal)) : Json();
}

}  // namespace panache::cli
