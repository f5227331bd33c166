#include "manual_page.h"

#include <algorithm>
#include <iterator>
#include <sstream>
#include <utility>
#include <vector>

namespace panache::cli {
namespace {

// Escapes special characters. roff would turn a hyphen into a typographic one.
constexpr std::pair<char, const char*> kEscapes[] = {
    {'\\', "\\e"}, {'-', "\\-"}, {'\'', "\\(aq"}, {'`', "\\(ga"}, {'^', "\\(ha"}, {'~', "\\(ti"}};

// A full stop or apostrophe at the start of a line would be read as a request.
std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    const bool starts_line = out.empty() || out.back() == '\n';
    if (starts_line && (c == '.' || c == '\'')) out += "\\&";
    const auto escape = std::ranges::find(kEscapes, c, &std::pair<char, const char*>::first);
    out += escape == std::end(kEscapes) ? std::string(1, c) : escape->second;
  }
  return out;
}

std::string bold(const std::string& text) { return "\\fB" + escaped(text) + "\\fR"; }
std::string italic(const std::string& text) { return "\\fI" + escaped(text) + "\\fR"; }

// "-o", "--output"; empty for a positional argument.
std::vector<std::string> names_of(const CLI::Option& option) {
  std::vector<std::string> names;
  for (const std::string& name : option.get_snames()) names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) names.push_back("--" + name);
  return names;
}

// "FILE"; empty for a flag. A positional argument without a type is named after itself.
std::string value_of(const CLI::Option& option) {
  if (option.get_items_expected_max() == 0) return "";
  const std::string type = option.get_type_name();
  const bool own_type = !type.empty() && type != CLI::detail::type_name<std::string>();
  return option.get_positional() && !own_type ? option.get_name(true) : type;
}

std::string dots_of(const CLI::Option& option) {
  return option.get_positional() && option.get_items_expected_max() > 1 ? "..." : "";
}

// "-o, --output OUT", or "FILE..." for a positional argument.
std::string tag_of(const CLI::Option& option) {
  std::string tag;
  for (const std::string& name : names_of(option)) tag += (tag.empty() ? "" : ", ") + bold(name);
  const std::string value = value_of(option);
  if (!value.empty()) tag += (tag.empty() ? "" : " ") + italic(value);
  return tag + dots_of(option);
}

// "[--force]", "--onto FILE".
std::string usage_of(const CLI::Option& option) {
  std::string text = option.get_positional() ? "" : bold(names_of(option).back());
  const std::string value = value_of(option);
  if (!value.empty()) text += (text.empty() ? "" : " ") + italic(value);
  text += dots_of(option);
  return option.get_required() ? text : "[" + text + "]";
}

std::vector<const CLI::Option*> options_of(const CLI::App& verb) {
  return verb.get_options([](const CLI::Option* option) { return !option->get_group().empty(); });
}

void write_options(std::string& out, const CLI::App& verb) {
  for (const CLI::Option* option : options_of(verb)) {
    std::string description = option->get_description();
    std::ranges::replace(description, '\n', ' ');
    out += ".TP\n" + tag_of(*option) + "\n" + escaped(description);
    out += option->get_required() ? " (required)\n" : "\n";
  }
}

// Notes and examples: indented lines keep their layout, an empty line begins a paragraph.
void write_footer(std::string& out, const std::string& footer) {
  std::istringstream lines(footer);
  bool in_example = false;
  out += ".PP\n";
  for (std::string line; std::getline(lines, line);) {
    const bool is_example = line.starts_with("  ");
    if (is_example != in_example) out += is_example ? ".RS 4\n.nf\n" : ".fi\n.RE\n";
    in_example = is_example;
    if (is_example) line.erase(0, 2);
    if (line.empty()) {
      out += ".PP\n";
    } else {
      out += escaped(line) + "\n";
    }
  }
  if (in_example) out += ".fi\n.RE\n";
}

// The required arguments of a verb in command-line order, and a placeholder for the rest.
std::string synopsis_of(const CLI::App& verb, const std::string& name) {
  std::string text = bold("panache") + " " + bold(name);
  for (const bool positional : {true, false}) {
    for (const CLI::Option* option : options_of(verb)) {
      const bool shown =
          option->get_positional() ? positional : option->get_required() && !positional;
      if (shown) text += " " + usage_of(*option);
    }
  }
  return text + " [" + italic("options") + "]";
}

// Calls visit(verb, name) for each in the order of --help, and after it for those within it, such
// as "live send".
template <class Visit>
void each_verb(const CLI::App& app, const std::string& prefix, Visit&& visit) {
  for (const CLI::App* verb : app.get_subcommands([](const CLI::App*) { return true; })) {
    if (verb->get_group().empty()) continue;
    visit(*verb, prefix + verb->get_name());
    each_verb(*verb, prefix + verb->get_name() + " ", visit);
  }
}

constexpr const char* kEnvironment = R"(.SH ENVIRONMENT
.TP
.B PANACHE_MODEL
The model that is used where \fB\-\-model\fR names none; default: the one shipped.
.SH EXIT STATUS
.TP
.B 0
Success.
.TP
.B 1
Bad input: a file is not what it should be, or cannot be written.
.TP
.B 2
Bad usage: an unknown command or option, or a value out of range.
)";

}  // namespace

std::string manual_page(const CLI::App& program, const std::string& version) {
  std::string out = ".TH PANACHE 1 \"\" \"panache " + version + "\" \"User Commands\"\n";
  // Disables hyphenation and justification, so that options and file names stay intact.
  out += ".nh\n.ad l\n.SH NAME\npanache \\- change the style of motion\n.SH SYNOPSIS\n";
  each_verb(program, "", [&](const CLI::App& verb, const std::string& name) {
    out += synopsis_of(verb, name) + "\n.br\n";
  });
  out += bold("panache") + " " + bold("help") + " [" + italic("command") + "]\n";
  out += ".SH DESCRIPTION\n" + escaped(program.get_description()) + "\n";
  write_footer(out, program.get_footer());
  out += ".SH OPTIONS\n";
  write_options(out, program);
  out += ".SH COMMANDS\n";
  each_verb(program, "", [&](const CLI::App& verb, const std::string& name) {
    out += ".SS panache " + name + "\n" + escaped(verb.get_description()) + ".\n";
    write_options(out, verb);
    write_footer(out, verb.get_footer());
  });
  return out + kEnvironment;
}

}  // namespace panache::cli
