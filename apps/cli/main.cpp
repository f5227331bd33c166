// panache: the program. Each verb is a file of its own.

#include <algorithm>
#include <cstdio>
#include <exception>
#include <new>
#include <string>
#include <string_view>
#include <vector>

#include "base/one_of.h"
#include "fbx.h"
#include "formats.h"
#include "messages.h"
#include "option_table.h"
#include "style/names.h"
#include "verbs.h"

namespace panache::cli {
namespace {

constexpr std::string_view kHelp = "help";

// "; the nearest is stylize", with `dashes` before the name; empty where no name begins alike.
std::string nearest(const std::string& wanted, const std::vector<std::string>& names,
                    const std::string& dashes = "") {
  constexpr size_t kAlike = 1;
  const std::string found = list_nearest(wanted, names, 1);
  return found.substr(0, kAlike) == wanted.substr(0, kAlike) ? "; the nearest is " + dashes + found
                                                             : "";
}

// The library's own message for a verb that does not exist names no verb that does.
Result<void> check_verb(const CLI::App& app, const std::string& verb) {
  std::vector<std::string> names;
  for (const CLI::App* known : app.get_subcommands([](const CLI::App*) { return true; })) {
    if (known->get_name() == verb) return {};
    names.push_back(known->get_name());
  }
  return Error{"there is no command '" + verb + "'" + nearest(verb, names) + "; expected " +
               one_of(names)};
}

// The same of the first option that a verb does not have; empty where there is none.
std::string nearest_option(const CLI::App& app, const std::string& verb) {
  for (const std::string& argument : app.remaining(true)) {
    if (!argument.starts_with("--")) continue;
    std::vector<std::string> names;
    for (const CLI::Option* option : app.get_subcommand(verb)->get_options()) {
      for (const std::string& name : option->get_lnames()) names.push_back(name);
    }
    return nearest(argument.substr(2, argument.find('=') - 2), names, "--");
  }
  return "";
}

std::string one_line(std::string text) {
  while (!text.empty() && (text.back() == '\n' || text.back() == '.')) text.pop_back();
  for (char& c : text) {
    if (c == '\n') c = ' ';
  }
  return text;
}

int run(int argc, char** argv) {
  if (argc == 3 && argv[1] == std::string_view(kFbxReader)) return read_fbx_as_child(argv[2]);
  set_motion_formats(formats());  // Those of manifests, too.
  int exit_code = kDone;
  CLI::App app(
      "Panache changes the style of motion: neutral motion in, the same motion in an angry, old or "
      "proud style out.",
      "panache");
  app.set_version_flag("--version", "panache " PANACHE_VERSION);
  app.require_subcommand(1);
  app.get_formatter()->column_width(32);
  app.footer(
      "'panache help COMMAND' shows details and an example.\n\nExample:\n"
      "  panache stylize walk.bvh --style old=1 -o old.bvh");
#define PANACHE_ADD_VERB(name) add_##name(app, exit_code);
  PANACHE_VERBS(PANACHE_ADD_VERB)
#undef PANACHE_ADD_VERB
  if (argc == 3 && argv[1] == std::string_view(kPrintReference)) {
    return print_reference(app, argv[2], PANACHE_VERSION);
  }
  if (argc < 2) {
    std::fputs(app.help().c_str(), stderr);
    return kBadUsage;
  }
  std::vector<std::string> arguments(argv + 1, argv + argc);
  if (arguments[0] == kHelp) {  // "help" is "--help", and "help VERB" is "VERB --help".
    arguments.erase(arguments.begin());
    arguments.emplace_back("--help");
  }
  const std::string verb = arguments[0];
  if (verb[0] != '-') {
    if (auto known = check_verb(app, verb); !known) return fail(known.error(), kBadUsage);
  }
  try {
    std::reverse(arguments.begin(), arguments.end());  // As CLI11 wants them.
    app.parse(std::move(arguments));
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // --help and --version.
    const bool named = verb[0] != '-';
    const bool extra = named && dynamic_cast<const CLI::ExtrasError*>(&error);
    return fail({one_line(error.what()) + (extra ? nearest_option(app, verb) : "") +
                 "; see panache " + (named ? verb + " " : "") + "--help"},
                kBadUsage);
  }
  return exit_code;
}

}  // namespace
}  // namespace panache::cli

int main(int argc, char** argv) {
  using namespace panache::cli;
  try {
    return run(argc, argv);
  } catch (const std::bad_alloc&) {
    print_message("out of memory");
  } catch (const std::exception& error) {
    // Of libraries below. Those of libtorch go on with where in its sources they come from.
    const std::string_view text = error.what();
    print_message("internal error: " + std::string(text.substr(0, text.find('\n'))));
  }
  return kBadInput;
}
