#pragma once
// The verbs of the program. Each add_* makes its subcommand; running it sets `exit_code`.

#include <CLI/CLI.hpp>

namespace panache::cli {

void add_stylize(CLI::App& app, int& exit_code);
void add_convert(CLI::App& app, int& exit_code);
void add_learn(CLI::App& app, int& exit_code);
void add_styles(CLI::App& app, int& exit_code);
void add_info(CLI::App& app, int& exit_code);
void add_walker(CLI::App& app, int& exit_code);
void add_strip(CLI::App& app, int& exit_code);
void add_halve(CLI::App& app, int& exit_code);
void add_bench(CLI::App& app, int& exit_code);
// In a build without cpp-httplib this one exists and says so.
void add_view(CLI::App& app, int& exit_code);
// In a build without liblo these two exist and say so.
void add_live(CLI::App& app, int& exit_code);
void add_send(CLI::App& app, int& exit_code);
// In a build without training these two exist and say so.
void add_train(CLI::App& app, int& exit_code);
void add_eval(CLI::App& app, int& exit_code);

}  // namespace panache::cli
