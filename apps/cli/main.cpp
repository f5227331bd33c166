// panache: the program. Each verb is a file of its own.

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
#include "verbs.h"

namespace panache::cli {
namespace {

// The library's own message for a verb that does not exist names no verb that does.
Result<void> check_verb(const CLI::App& app, const std::string& verb) {
  std::vector<std::string> names;
  for (const CLI::App* known : app.get_subcommands([](const CLI::App*) { return true; })) {
    if (known->get_name() == verb) return {};
    names.push_back(known->get_name());
  }
  return Error{"there is no command '" + verb + "'; expected " + one_of(names)};
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
      "'panache COMMAND --help' shows details and an example.\n\nExample:\n"
      "  panache stylize walk.bvh --style old=1 -o old.bvh");
#define PANACHE_ADD_VERB(name) add_##name(app, exit_code);
  PANACHE_VERBS(PANACHE_ADD_VERB)
#undef PANACHE_ADD_VERB
  if (argc < 2) {
    std::fputs(app.help().c_str(), stderr);
    return kBadUsage;
  }
  if (argv[1][0] != '-') {
    if (auto known = check_verb(app, argv[1]); !known) return fail(known.error(), kBadUsage);
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // --help and --version.
    const std::string verb = argv[1][0] == '-' ? "" : std::string(" ") + argv[1];
    return fail({one_line(error.what()) + "; see panache" + verb + " --help"}, kBadUsage);
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
