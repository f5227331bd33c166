#include "messages.h"

#include <cmath>
#include <algorithm>
#include <array>
#include <cstdio>
#include <string_view>

#include "clip/motion_file.h"

namespace panache::cli {
namespace {

const char* program_name = "panache";

}  // namespace

void set_program_name(const char* name) { program_name = name; }

void print_message(const std::string& message) {
  std::fprintf(stderr, "%s: %s\n", program_name, message.c_str());
}

std::string with_hint(const std::string& message) {
  constexpr std::string_view kUnknown = "unknown style '", kNearest = "; the nearest ",
                             kModel = ": is a model; expected a style file";
  struct Hint {
    std::string_view end, hint;
  };
  constexpr std::array kHints = {
      Hint{": exists already", "; --force overwrites it"},
      Hint{"; replace it or give one of the two another name", " (--force, --rename)"},
      Hint{"; expected a safetensors file", ", as models and styles are"},
      Hint{"found the extension '.safetensors'", ", which models and styles have"},
      Hint{": is a style file, not a model", "; panache styles MODEL --add FILE puts it into one"},
      Hint{"or learn it again with this one", " (panache learn)"},
      Hint{"'learn.mean' and 'learn.scale'", ", as panache-lab train writes it"},
      Hint{"or retarget the styled clip onto the neutral one",
           " (panache retarget STYLED --onto NEUTRAL)"},
      Hint{"'; rename them", " with --styles"},
      Hint{"; give it another name", " (--styles)"},
      Hint{"; add one, or leave the style out", " (--styles lists those to learn)"},
      Hint{"; add one, or leave the styles out", " (--styles lists those to learn)"},
      Hint{"; add some, or leave the style out", " (--styles lists those to learn)"},
      Hint{"the model has no styles yet", "; panache learn adds one"},
      Hint{", as where a clip is cut after a whole cycle", "; --loop auto leaves it open"},
      Hint{"has another strength at its last frame than at its first",
           "; --loop auto leaves it open"},
      Hint{kGiveRate, " (--fps N; panache convert --fps N writes the file with it)"},
  };
  for (const Hint& one : kHints) {
    if (message.ends_with(one.end)) return message + std::string(one.hint);
  }
  if (message.ends_with(kModel)) {
    return message + ", as panache styles " + message.substr(0, message.size() - kModel.size()) +
           " --extract NAME -o FILE makes one";
  }
  if (message.find(kUnknown) == std::string::npos || message.ends_with(')')) return message;
  if (message.find(kNearest) == std::string::npos) return message;  // It lists all itself.
  return message + " (panache styles lists all)";
}

int fail(const Error& error, int exit_code) {
  print_message(with_hint(error.message));
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
