#include "messages.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string_view>

namespace panache::cli {
namespace {

const char* program_name = "panache";

std::string_view hint_of(ErrorKind kind) {
  switch (kind) {
    case ErrorKind::file_exists:
      return "; --force overwrites it";
    case ErrorKind::rate_needed:
      return kRateHint;
    case ErrorKind::unknown_style:
      return " (panache styles lists all)";
    case ErrorKind::no_styles:
      return "; panache learn adds one";
    case ErrorKind::style_exists:
      return " (--force, --rename)";
    case ErrorKind::is_model:
      return ", as panache styles MODEL --extract NAME -o FILE makes one";
    case ErrorKind::is_style_file:
      return "; panache styles MODEL --add FILE puts it into one";
    case ErrorKind::style_of_another:
      return " (panache learn)";
    case ErrorKind::not_safetensors:
      return ", as models and styles are";
    case ErrorKind::model_cannot_learn:
      return ", as panache-lab train writes it";
    case ErrorKind::other_skeletons:
      return " (panache retarget STYLED --onto NEUTRAL)";
    case ErrorKind::loop_open:
    case ErrorKind::loop_strengths:
      return "; --loop auto leaves it open";
    case ErrorKind::bad_style_name:
      return " (--styles)";
    case ErrorKind::not_humanoid:
    case ErrorKind::other:
      break;
  }
  return "";
}

}  // namespace

void set_program_name(const char* name) { program_name = name; }

void print_message(const std::string& message) {
  std::fprintf(stderr, "%s: %s\n", program_name, message.c_str());
}

std::string with_hint(const Error& error) {
  return error.message + std::string(hint_of(error.kind));
}

int fail(const Error& error, int exit_code) {
  print_message(with_hint(error));
  return exit_code;
}

void print(const std::string& text) { std::fwrite(text.data(), 1, text.size(), stdout); }

void print(const Json& json) { print(dump(json)); }

std::string dump(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string fixed(double value, int decimals) {
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", decimals, value);
  return text;
}

std::string brief(double value, int digits) {
  char text[64];
  std::snprintf(text, sizeof text, "%.*g", digits, value);
  return text;
}

double rounded(double value) { return std::round(value * 1e4) / 1e4; }

std::string plural(size_t count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

std::string padded(const std::string& text, size_t width) {
  const auto letters = static_cast<size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xc0) != 0x80; }));
  return text + std::string(letters < width ? width - letters : 1, ' ');
}

Result<void> check_range(const std::string& option, double value, double low, double high) {
  if (value >= low && value <= high) return {};
  return Error{option + ": expected a number from " + brief(low) + " to " + brief(high) +
               ", found " + brief(value)};
}

}  // namespace panache::cli
