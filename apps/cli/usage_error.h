#pragma once
// What is wrong with a command line, in our words: CLI11's own name types and internals.

#include <string>

#include <CLI/CLI.hpp>

namespace panache::cli {

// The message for arguments that could not be parsed. `verb` is the command whose arguments they
// are, or the program itself where no command was named.
std::string usage_message(const CLI::ParseError& error, const CLI::App& verb);

// Accepts numbers from `low` to `high`; the message is that of check_range().
CLI::Validator in_range(double low, double high);

}  // namespace panache::cli
