#pragma once
// Options, messages, results and exit codes of the program.

#include <string>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "base/result.h"
#include "base/text.h"

namespace panache::cli {

inline constexpr int kDone = 0;
inline constexpr int kBadInput = 1;   // A file is invalid or cannot be written.
inline constexpr int kBadUsage = 2;   // Invalid command line.
inline constexpr int kStopped = 130;  // After Ctrl-C, by shell convention.

// The name that messages begin with, "panache" by default. The string is not copied.
void set_program_name(const char* name);
// "panache: MESSAGE" on stderr.
void print_message(const std::string& message);
// The message of an error, followed by the command or option that helps, if its kind has one: the
// library does not know the command line.
std::string with_hint(const Error& error);
// The hint for files with a questionable frame rate.
inline constexpr const char* kRateHint =
    " (--fps N; panache convert --fps N writes the file with it)";
// Prints the message with its hint and returns `exit_code`.
int fail(const Error& error, int exit_code);

// Thrown by a verb that cannot continue: run_program() prints the message and returns the exit
// code; run_batch() continues with the next file.
struct Failure {
  Error error;
  int exit_code;
};
// The value of a result; throws Failure if there is none.
inline void need(const Result<void>& result, int exit_code = kBadInput) {
  if (!result) throw Failure{result.error(), exit_code};
}
template <class T>
T need(Result<T> result, int exit_code = kBadInput) {
  if (!result) throw Failure{result.error(), exit_code};
  return *std::move(result);
}

// Results for people and for machines, on stdout.
void print(const std::string& text);
using Json = nlohmann::ordered_json;
void print(const Json& json);
// JSON for printing: indented, with a final newline. Invalid UTF-8, as in file names, is replaced.
std::string dump(const Json& json);

// `value` with `decimals` digits after the point.
std::string fixed(double value, int decimals);
// `value` without trailing zeros, and with at most `digits` significant digits: "120", "0.0564".
std::string brief(double value, int digits = 6);
// `value` to four decimals, for JSON.
double rounded(double value);
// `text` padded with spaces to `width` characters (UTF-8), with at least one space.
std::string padded(const std::string& text, size_t width);

// "--every: expected a number from 0.01 to 60, found nan" unless low <= value <= high.
Result<void> check_range(const std::string& option, double value, double low, double high);

// An option of `verb`: its names and, after a space, the name of its value: "-o,--output OUT".
template <class T>
CLI::Option* add_option(CLI::App& verb, const std::string& names, T& value,
                        const std::string& description) {
  const size_t space = names.find(' ');
  return verb.add_option(names.substr(0, space), value, description)
      ->type_name(names.substr(space + 1));
}

}  // namespace panache::cli
