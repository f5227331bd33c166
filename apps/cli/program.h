#pragma once
// What this project's programs share: the command line, its errors in our words (CLI11's
// messages mention types and internals), messages and exit codes.

#include <CLI/CLI.hpp>
#include <memory>
#include <string>

namespace panache::cli {

struct Program {
  const char* name;
  const char* description;  // One sentence.
  const char* example;      // A command line.
  // Adds the verbs in the order of --help; running a verb sets the exit code.
  void (*add_verbs)(CLI::App& app, int& exit_code);
};

// The command line of a program. `exit_code` must outlive it.
std::unique_ptr<CLI::App> make_app(const Program& program, int& exit_code);

// Runs the program and returns its exit code. Prints errors, including exceptions.
int run_program(const Program& program, int argc, char** argv);

// The message for arguments that could not be parsed. `verb` is the command they belong to, or the
// program itself if no command was given.
std::string usage_message(const CLI::ParseError& error, const CLI::App& verb);

// Accepts numbers from `low` to `high`; otherwise fails with the message of check_range().
CLI::Validator in_range(double low, double high);

}  // namespace panache::cli
