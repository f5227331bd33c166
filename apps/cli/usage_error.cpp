#include "usage_error.h"

#include <algorithm>
#include <vector>

#include "base/nearest_names.h"
#include "clip/text_cursor.h"
#include "messages.h"

namespace panache::cli {
namespace {

// Joins the lines of a CLI11 message and removes a final full stop.
std::string one_line(std::string text) {
  while (!text.empty() && (text.back() == '\n' || text.back() == '.')) text.pop_back();
  std::ranges::replace(text, '\n', ' ');
  return text;
}

// The first unparsed argument that looks like an option, or "".
std::string unknown_option(const CLI::App& verb) {
  for (const std::string& extra : verb.remaining(true)) {
    if (extra.size() > 1 && extra[0] == '-') return extra.substr(0, extra.find('='));
  }
  return "";
}

std::string describe_option(const CLI::App& verb, const std::string& option) {
  std::vector<std::string> names;
  for (const CLI::Option* known : verb.get_options()) {
    for (const std::string& name : known->get_lnames()) names.push_back("--" + name);
  }
  const std::vector<std::string> nearest =
      option.starts_with("--") ? nearest_names(option, names, 1) : std::vector<std::string>();
  return "there is no option " + panache::quoted(option) +
         (nearest.empty() ? "" : "; the nearest " + is_or_are(nearest));
}

// Describes the first unparsed argument. CLI11 returns them last first if one is an option.
std::string describe_extra(const CLI::App& verb) {
  const std::string option = unknown_option(verb);
  if (option.empty()) return "unexpected argument " + panache::quoted(verb.remaining(true).front());
  return describe_option(verb, option);
}

}  // namespace

std::string usage_message(const CLI::ParseError& error, const CLI::App& verb) {
  std::string text = one_line(error.what());
  if (dynamic_cast<const CLI::ExtrasError*>(&error)) return describe_extra(verb);
  if (dynamic_cast<const CLI::RequiredError*>(&error)) {
    if (!verb.get_parent()) return "expected a command first";
    // The required option may be missing because it was mistyped.
    const std::string option = unknown_option(verb);
    return option.empty() ? text : describe_option(verb, option) + "; " + text;
  }
  if (dynamic_cast<const CLI::ArgumentMismatch*>(&error)) {
    // "--style: 1 required STYLE missing".
    return text.substr(0, text.find(':')) + ": expected a value after it";
  }
  constexpr std::string_view kNoNumber = "Could not convert: ";
  if (text.starts_with(kNoNumber)) {  // "Could not convert: --speed = abc".
    const size_t equals = text.find(" = ");
    return text.substr(kNoNumber.size(), equals - kNoNumber.size()) +
           ": expected a number, found " + panache::quoted(text.substr(equals + 3));
  }
  return text;
}

CLI::Validator in_range(double low, double high) {
  return CLI::Validator(
      [=](std::string& text) {
        double value = 0;
        if (!CLI::detail::lexical_cast(text, value)) {
          return "expected a number from " + brief(low) + " to " + brief(high) + ", found " +
                 panache::quoted(text);
        }
        const auto good = check_range("", value, low, high);
        return good ? std::string() : good.error().message.substr(2);
      },
      "");
}

}  // namespace panache::cli
