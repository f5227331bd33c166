#pragma once
// The verbs and options of the program as data, from which the manual page and shell completions
// are made.

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace panache::cli {

// An option, flag or positional argument.
struct OptionEntry {
  std::vector<std::string> names;  // "-o", "--output"; empty for a positional argument.
  std::string value;               // "FILE"; empty for a flag.
  std::string description;         // One line.
  bool required = false;
  bool repeated = false;  // A positional argument that accepts several values.

  bool is_positional() const { return names.empty(); }
};

struct VerbEntry {
  std::string name;  // "stylize"; "live send" for a nested verb.
  std::string description;
  std::string footer;  // Notes and examples shown by --help.
  std::vector<OptionEntry> options;

  // Parent and own name of a nested verb ("live" and "send"); else "" and the name.
  std::string parent() const;
  std::string word() const;
};

// The program itself, without a name, then its verbs in the order of --help, each followed by its
// nested verbs.
std::vector<VerbEntry> option_table(const CLI::App& app);

// A hidden first argument, used by the build: prints the text named by the second argument.
inline constexpr const char* kPrintReference = "--print-reference";

// The manual page (roff) or the completions of a shell for a program with these verbs.
std::string manual_page(const std::vector<VerbEntry>& verbs, const std::string& version);
std::string bash_completion(const std::vector<VerbEntry>& verbs);
std::string zsh_completion(const std::vector<VerbEntry>& verbs);
std::string fish_completion(const std::vector<VerbEntry>& verbs);

// Prints the text named by `what`: man, bash, zsh or fish; or, for "styles", the names of the
// default model's styles, one a line. Returns the exit code.
int print_reference(const CLI::App& app, const std::string& what, const std::string& version);

}  // namespace panache::cli
