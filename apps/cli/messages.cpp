#include "messages.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <string_view>
#include <utility>

namespace panache::cli {
namespace {

const char* program_name = "panache";

constexpr std::pair<ErrorKind, std::string_view> kHints[] = {
    {ErrorKind::file_exists, "; --force overwrites it"},
    {ErrorKind::rate_needed, kRateHint},
    {ErrorKind::unknown_style, " (panache styles lists all)"},
    {ErrorKind::no_styles, "; panache learn adds one"},
    {ErrorKind::style_exists, " (--force, --rename)"},
    {ErrorKind::is_model, ", as panache styles MODEL --extract NAME -o FILE makes one"},
    {ErrorKind::is_style_file, "; panache styles MODEL --add FILE puts it into one"},
    {ErrorKind::style_of_another, " (panache learn)"},
    {ErrorKind::not_safetensors, ", as models and styles are"},
    {ErrorKind::model_cannot_learn, ", as panache-lab train writes it"},
    {ErrorKind::other_skeletons, " (panache retarget STYLED --onto NEUTRAL)"},
    {ErrorKind::loop_open, "; --loop auto leaves it open"},
    {ErrorKind::loop_strengths, "; --loop auto leaves it open"},
    {ErrorKind::bad_style_name, " (--styles)"},
};

}  // namespace

void set_program_name(const char* name) { program_name = name; }

void print_message(const std::string& message) {
  std::fprintf(stderr, "%s: %s\n", program_name, message.c_str());
}

std::string with_hint(const Error& error) {
  const auto hint =
      std::ranges::find(kHints, error.kind, &std::pair<ErrorKind, std::string_view>::first);
  return error.message + (hint == std::end(kHints) ? "" : std::string(hint->second));
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

std::string padded(const std::string& text, size_t width) {
  const size_t letters = character_count(text);
  return text + std::string(letters < width ? width - letters : 1, ' ');
}

Result<void> check_range(const std::string& option, double value, double low, double high) {
  if (value >= low && value <= high) return {};
  return Error{option + ": expected a number from " + brief(low) + " to " + brief(high) +
               ", found " + brief(value)};
}

}  // namespace panache::cli
