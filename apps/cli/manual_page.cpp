// Writes the manual page in roff, with the macros of man(7).

#include <algorithm>
#include <iterator>
#include <sstream>
#include <utility>

#include "option_table.h"

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

// "-o, --output OUT", or "FILE..." for a positional argument.
std::string tag_of(const OptionEntry& option) {
  std::string tag;
  for (const std::string& name : option.names) tag += (tag.empty() ? "" : ", ") + bold(name);
  if (!option.value.empty()) tag += (tag.empty() ? "" : " ") + italic(option.value);
  return option.repeated ? tag + "..." : tag;
}

// "[--force]", "--onto FILE".
std::string usage_of(const OptionEntry& option) {
  std::string text = option.is_positional() ? "" : bold(option.names.back());
  if (!option.value.empty()) text += (text.empty() ? "" : " ") + italic(option.value);
  if (option.repeated) text += "...";
  return option.required ? text : "[" + text + "]";
}

void write_options(std::string& out, const VerbEntry& verb) {
  for (const OptionEntry& option : verb.options) {
    out += ".TP\n" + tag_of(option) + "\n" + escaped(option.description);
    out += option.required ? " (required)\n" : "\n";
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
std::string synopsis_of(const VerbEntry& verb) {
  std::string text = bold("panache") + " " + bold(verb.name);
  for (const bool positional : {true, false}) {
    for (const OptionEntry& option : verb.options) {
      const bool shown = option.is_positional() ? positional : option.required && !positional;
      if (shown) text += " " + usage_of(option);
    }
  }
  return text + " [" + italic("options") + "]";
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

std::string manual_page(const std::vector<VerbEntry>& verbs, const std::string& version) {
  const VerbEntry& program = verbs.front();
  std::string out = ".TH PANACHE 1 \"\" \"panache " + version + "\" \"User Commands\"\n";
  // Disables hyphenation and justification, so that options and file names stay intact.
  out += ".nh\n.ad l\n.SH NAME\npanache \\- change the style of motion\n.SH SYNOPSIS\n";
  for (const VerbEntry& verb : verbs) {
    if (!verb.name.empty()) out += synopsis_of(verb) + "\n.br\n";
  }
  out += bold("panache") + " " + bold("help") + " [" + italic("command") + "]\n";
  out += ".SH DESCRIPTION\n" + escaped(program.description) + "\n";
  write_footer(out, program.footer);
  out += ".SH OPTIONS\n";
  write_options(out, program);
  out += ".SH COMMANDS\n";
  for (const VerbEntry& verb : verbs) {
    if (verb.name.empty()) continue;
    out += ".SS panache " + verb.name + "\n" + escaped(verb.description) + ".\n";
    write_options(out, verb);
    write_footer(out, verb.footer);
  }
  return out + kEnvironment;
}

}  // namespace panache::cli
