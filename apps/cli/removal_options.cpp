#include "removal_options.h"

#include "model_path.h"
#include "style/names.h"

namespace panache::cli {
namespace {

const std::string& name_of(const Removal& removal) {
  return removal.remover->styles()[static_cast<size_t>(removal.style)].name;
}

}  // namespace

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
