#include "program.h"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>
#include <string>
#include <string_view>
#include <vector>

#include "base/text.h"
#include "clip/text_cursor.h"
#include "fbx.h"
#include "formats.h"
#include "messages.h"
#include "picture.h"
#include "standard_streams.h"

namespace panache::cli {
namespace {

constexpr std::string_view kHelp = "help";

// CLI11's own message for an unknown verb lists no known ones.
Result<void> check_verb(const CLI::App& app, const std::string& verb) {
  std::vector<std::string> names;
  for (const CLI::App* known : app.get_subcommands([](const CLI::App*) { return true; })) {
    if (known->get_name() == verb) return {};
    names.push_back(known->get_name());
  }
  const std::vector<std::string> nearest = nearest_names(verb, names, 1);
  return Error{"there is no command '" + verb + "'" +
               (nearest.empty() ? "" : "; the nearest " + is_or_are(nearest)) + "; expected " +
               one_of(names)};
}

// The command that was parsed: the program, a verb, or a nested verb.
const CLI::App& last_command(const CLI::App& app) {
  const std::vector<CLI::App*> parsed = app.get_subcommands();
  return parsed.empty() ? app : last_command(*parsed.front());
}

// "panache stylize".
std::string full_name(const CLI::App& command) {
  const CLI::App* parent = command.get_parent();
  return (parent ? full_name(*parent) + " " : "") + command.get_name();
}

int run(const Program& program, int argc, char** argv) {
  if (argc == 3 && argv[1] == std::string_view(kFbxReader)) return read_fbx_as_child(argv[2]);
  if (argc == 3 && argv[1] == std::string_view(kPictureReader)) {
    return read_picture_as_child(argv[2]);
  }
  set_meshopt_decoder(kMeshoptDecoder);
  set_motion_formats(formats());  // For manifests, too.
  int exit_code = kDone;
  const std::unique_ptr<CLI::App> app = make_app(program, exit_code);
  if (argc < 2) {
    std::fputs(app->help().c_str(), stderr);
    return kBadUsage;
  }
  std::vector<std::string> arguments(argv + 1, argv + argc);
  if (arguments[0] == kHelp) {  // "help" is "--help", and "help VERB" is "VERB --help".
    arguments.erase(arguments.begin());
    arguments.emplace_back("--help");
  }
  if (arguments[0][0] != '-') {
    if (auto known = check_verb(*app, arguments[0]); !known) return fail(known.error(), kBadUsage);
  }
  try {
    std::reverse(arguments.begin(), arguments.end());  // CLI11 expects them reversed.
    app->parse(std::move(arguments));
  } catch (const Failure& failure) {
    return fail(failure.error, failure.exit_code);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app->exit(error);  // --help and --version.
    const CLI::App& command = last_command(*app);
    return fail({usage_message(error, command) + "; see " + full_name(command) + " --help"},
                kBadUsage);
  }
  return exit_code;
}

// Memory kept in reserve and freed when memory first runs out: nlohmann's JSON allocates in its
// destructor, which would abort the program while an exception is in flight.
std::atomic<void*> reserve{nullptr};
constexpr size_t kReserve = 1 << 16;

[[noreturn]] void out_of_memory() {
  std::free(reserve.exchange(nullptr));
  throw std::bad_alloc();
}

// The final exit code, after checking that all output was written. A reader that closed the pipe,
// such as head, is not an error.
int check_printed(int exit_code) {
  const Result<void> printed = finish_stdout();
  if (printed) return exit_code;
  if (errno != EPIPE) print_message(printed.error().message);
  return exit_code == kDone ? kBadInput : exit_code;
}

}  // namespace

std::unique_ptr<CLI::App> make_app(const Program& program, int& exit_code) {
  const std::string name = program.name;
  auto app = std::make_unique<CLI::App>(program.description, name);
  app->set_version_flag("--version", name + " " PANACHE_VERSION);
  app->require_subcommand(1);
  app->get_formatter()->column_width(32);
  app->footer("'" + name + " help COMMAND' shows details and an example.\n\nExample:\n  " +
              program.example);
  program.add_verbs(*app, exit_code);
  return app;
}

int run_program(const Program& program, int argc, char** argv) {
  set_program_name(program.name);
  reserve = std::malloc(kReserve);
  std::set_new_handler(out_of_memory);
  try {
    return check_printed(run(program, argc, argv));
  } catch (const std::bad_alloc&) {
    print_message("out of memory");
  } catch (const std::exception& error) {
    // From libraries. libtorch appends its source location to messages.
    const std::string_view text = error.what();
    if (text.find("can't allocate memory") != std::string_view::npos) {
      print_message("out of memory");
    } else {
      print_message("internal error: " + std::string(text.substr(0, text.find('\n'))));
    }
  }
  return kBadInput;
}

namespace {

// Joins the lines of a CLI11 message and removes a final full stop.
std::string one_line(std::string text) {
  while (!text.empty() && (text.back() == '\n' || text.back() == '.')) text.pop_back();
  std::ranges::replace(text, '\n', ' ');
  return text;
}

// The first unparsed argument that looks like an option, or "".
std::string unknown_option(const CLI::App& verb) {
  for (const std::string& extra : verb.remaining(true)) {
    if (extra.size() > 1 && extra[0] == '-') return extra.substr(0, extra.find('='));
  }
  return "";
}

std::string describe_option(const CLI::App& verb, const std::string& option) {
  std::vector<std::string> names;
  for (const CLI::Option* known : verb.get_options()) {
    for (const std::string& name : known->get_lnames()) names.push_back("--" + name);
  }
  const std::vector<std::string> nearest =
      option.starts_with("--") ? nearest_names(option, names, 1) : std::vector<std::string>();
  return "there is no option " + panache::quoted(option) +
         (nearest.empty() ? "" : "; the nearest " + is_or_are(nearest));
}

// Describes the first unparsed argument. CLI11 returns them last first if one is an option.
std::string describe_extra(const CLI::App& verb) {
  const std::string option = unknown_option(verb);
  if (option.empty()) return "unexpected argument " + panache::quoted(verb.remaining(true).front());
  return describe_option(verb, option);
}

}  // namespace

std::string usage_message(const CLI::ParseError& error, const CLI::App& verb) {
  std::string text = one_line(error.what());
  if (dynamic_cast<const CLI::ExtrasError*>(&error)) return describe_extra(verb);
  if (dynamic_cast<const CLI::RequiredError*>(&error)) {
    if (!verb.get_parent()) return "expected a command first";
    // The required option may be missing because it was mistyped.
    const std::string option = unknown_option(verb);
    return option.empty() ? text : describe_option(verb, option) + "; " + text;
  }
  if (dynamic_cast<const CLI::ArgumentMismatch*>(&error)) {
    // "--style: 1 required STYLE missing".
    return text.substr(0, text.find(':')) + ": expected a value after it";
  }
  constexpr std::string_view kNoNumber = "Could not convert: ";
  if (text.starts_with(kNoNumber)) {  // "Could not convert: --speed = abc".
    const size_t equals = text.find(" = ");
    return text.substr(kNoNumber.size(), equals - kNoNumber.size()) +
           ": expected a number, found " + panache::quoted(text.substr(equals + 3));
  }
  return text;
}

CLI::Validator in_range(double low, double high) {
  return CLI::Validator(
      [=](std::string& text) {
        double value = 0;
        if (!CLI::detail::lexical_cast(text, value)) {
          return "expected a number from " + brief(low) + " to " + brief(high) + ", found " +
                 panache::quoted(text);
        }
        const auto good = check_range("", value, low, high);
        return good ? std::string() : good.error().message.substr(2);
      },
      "");
}

}  // namespace panache::cli
