#pragma once
// The verbs and options of the program as data: what --help shows, for the manual page and the
// completions of shells.

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace panache::cli {

// An option, flag or positional argument.
struct OptionEntry {
  std::vector<std::string> names;  // "-o", "--output"; none where the argument is positional.
  std::string value;               // "FILE"; empty for a flag.
  std::string description;         // One line.
  bool required = false;
  bool repeated = false;  // A positional argument that may be given several times.

  bool is_positional() const { return names.empty(); }
};

struct VerbEntry {
  std::string name;  // "stylize"; "live send" for a verb of a verb.
  std::string description;
  std::string footer;  // Notes and examples, as --help prints them.
  std::vector<OptionEntry> options;

  // For a verb of a verb, the latter ("live") and its own word ("send"); else "" and the name.
  std::string parent() const;
  std::string word() const;
};

// The program itself, without a name, and then its verbs in the order of --help, each followed by
// its own verbs.
std::vector<VerbEntry> option_table(const CLI::App& app);

// The first argument that makes the program print one of the texts below, and the texts that the
// second may name. The build uses it; it is in no help.
inline constexpr const char* kPrintReference = "--print-reference";

// The manual page (roff), or the completion for a shell, for a program with these verbs.
std::string manual_page(const std::vector<VerbEntry>& verbs, const std::string& version);
std::string bash_completion(const std::vector<VerbEntry>& verbs);
std::string zsh_completion(const std::vector<VerbEntry>& verbs);
std::string fish_completion(const std::vector<VerbEntry>& verbs);

// Prints the text that `what` names: man, bash, zsh or fish; or, with "styles", the names of the
// default model's styles, one on each line. Returns the exit code.
int print_reference(const CLI::App& app, const std::string& what, const std::string& version);

}  // namespace panache::cli
