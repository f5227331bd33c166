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
  CLI::Option* remove = verb.add_option("--remove", flags.style,
                                        "The style that the input shows: it is taken off first");
  remove->type_name("STYLE");
  verb.add_flag("--neutral", flags.neutral, "Take whatever style the input shows off first")
      ->excludes(remove);
  verb.add_option("--remover", flags.remover,
                  "Model that takes styles off; default: the one shipped")
      ->type_name("FILE");
}

Result<std::optional<Removal>> read_removal(const RemovalFlags& flags, int& exit_code) {
  exit_code = kBadUsage;
  if (!flags.given()) {
    if (flags.remover.empty()) return std::optional<Removal>();
    return Error{"--remover: nothing is to be taken off; add --remove STYLE or --neutral"};
  }
  exit_code = kBadInput;
  Result<std::string> path =
      flags.remover.empty() ? find_shipped(kRemoverModel) : Result<std::string>(flags.remover);
  if (!path) return path.error();
  Result<std::shared_ptr<const Model>> remover = Model::load(*path);
  if (!remover) return remover.error();
  if (!is_remover(**remover)) {
    return Error{*path + ": puts styles on; expected a model that takes them off"};
  }
  exit_code = kBadUsage;
  Result<int> style = find_removal(**remover, flags.style);
  if (!style) return Error{"--remove: " + style.error().message};
  return std::optional(Removal{*std::move(remover), *style});
}

std::string describe(const Removal& removal) {
  return name_of(removal) == kAnyStyle ? "neutral" : name_of(removal) + " off";
}

Json removed_json(const std::optional<Removal>& removal) {
  return removal ? Json(name_of(*removal)) : Json();
}

}  // namespace panache::cli
