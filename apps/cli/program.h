#pragma once
// What this project's programs share: the command line, messages and exit codes.

#include <memory>

#include <CLI/CLI.hpp>

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

}  // namespace panache::cli
