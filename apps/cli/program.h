#pragma once
// What the programs of this project share: the command line, its messages and its exit codes.

#include <memory>

#include <CLI/CLI.hpp>

namespace panache::cli {

struct Program {
  const char* name;
  const char* description;  // One sentence.
  const char* example;      // A command line.
  // Adds the verbs in the order of --help; running one sets the exit code.
  void (*add_verbs)(CLI::App& app, int& exit_code);
};

// The command line of a program. `exit_code` has to live as long as it.
std::unique_ptr<CLI::App> make_app(const Program& program, int& exit_code);

// Runs the program and returns its exit code. Prints what goes wrong, exceptions too.
int run_program(const Program& program, int argc, char** argv);

}  // namespace panache::cli
