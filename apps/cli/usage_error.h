#pragma once
// Describes command line errors in our words: CLI11's messages mention types and internals.

#include <string>

#include <CLI/CLI.hpp>

namespace panache::cli {

// The message for arguments that could not be parsed. `verb` is the command they belong to, or the
// program itself if no command was given.
std::string usage_message(const CLI::ParseError& error, const CLI::App& verb);

// Accepts numbers from `low` to `high`; otherwise fails with the message of check_range().
CLI::Validator in_range(double low, double high);

}  // namespace panache::cli
