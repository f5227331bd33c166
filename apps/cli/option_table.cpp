#include "option_table.h"

#include <algorithm>

#include "messages.h"
#include "model_path.h"
#include "style/model/model.h"

namespace panache::cli {
namespace {

OptionEntry entry_of(const CLI::Option& option) {
  OptionEntry entry;
  for (const std::string& name : option.get_snames()) entry.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) entry.names.push_back("--" + name);
  // A flag takes no value. A positional argument without a type is named after itself.
  if (option.get_items_expected_max() > 0) {
    entry.value = option.get_type_name();
    const bool own_type =
        !entry.value.empty() && entry.value != CLI::detail::type_name<std::string>();
    if (entry.is_positional() && !own_type) entry.value = option.get_name(true);
  }
  entry.description = option.get_description();
  std::ranges::replace(entry.description, '\n', ' ');
  entry.required = option.get_required();
  entry.repeated = entry.is_positional() && option.get_items_expected_max() > 1;
  return entry;
}

VerbEntry entry_of(const CLI::App& app, const std::string& name) {
  VerbEntry entry{name, app.get_description(), app.get_footer(), {}};
  for (const CLI::Option* option : app.get_options()) {
    if (!option->get_group().empty()) entry.options.push_back(entry_of(*option));
  }
  return entry;
}

void add_entries(std::vector<VerbEntry>& verbs, const CLI::App& app, const std::string& name) {
  verbs.push_back(entry_of(app, name));
  for (const CLI::App* verb : app.get_subcommands([](const CLI::App*) { return true; })) {
    if (verb->get_group().empty()) continue;
    add_entries(verbs, *verb, (name.empty() ? "" : name + " ") + verb->get_name());
  }
}

// Kept for the completions, which ask many times.
int print_style_names() {
  const Result<std::string> path = find_model("");
  if (!path) return fail(path.error(), kBadInput);
  const Result<std::shared_ptr<const Model>> model = Model::load(*path);
  if (!model) return fail(model.error(), kBadInput);
  for (const StyleInfo& style : (*model)->styles()) print(style.name + "\n");
  return kDone;
}

}  // namespace

std::string VerbEntry::parent() const {
  const size_t space = name.find(' ');
  return space == std::string::npos ? "" : name.substr(0, space);
}

std::string VerbEntry::word() const {
  const size_t space = name.find(' ');
  return space == std::string::npos ? name : name.substr(space + 1);
}

std::vector<VerbEntry> option_table(const CLI::App& app) {
  std::vector<VerbEntry> verbs;
  add_entries(verbs, app, "");
  return verbs;
}

int print_reference(const CLI::App& app, const std::string& what, const std::string& version) {
  const std::vector<VerbEntry> verbs = option_table(app);
  if (what == "man") {
    print(manual_page(verbs, version));
  } else if (what == "bash") {
    print(bash_completion(verbs));
  } else if (what == "zsh") {
    print(zsh_completion(verbs));
  } else if (what == "fish") {
    print(fish_completion(verbs));
  } else if (what == "styles") {
    return print_style_names();
  } else {
    return fail({"no reference for '" + what + "'; expected man, bash, zsh, fish or styles"},
                kBadUsage);
  }
  return kDone;
}

}  // namespace panache::cli
