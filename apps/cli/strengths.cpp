#include "strengths.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <fast_float/fast_float.h>

#include "base/csv.h"
#include "base/text.h"
#include "clip/text_cursor.h"
#include "messages.h"

namespace panache::cli {
namespace {

constexpr char kExpectedStrength[] = "expected a strength from -4 to 4";

std::optional<float> parse_strength(std::string_view text) {
  const std::optional<double> value = parse_number(text);
  if (!value || *value < kLowestStrength || *value > kHighestStrength) return std::nullopt;
  return static_cast<float>(*value);
}

// "elderly is old here" if `text` is another word for a style; else empty.
std::string note_of_word(const std::string& text, const Model& model) {
  const Result<int> style = model.find_style_by_any_name(text);
  if (!style) return "";
  const std::string& name = model.styles()[static_cast<size_t>(*style)].name;
  return lower_case(name) == lower_case(text) ? "" : text + " is " + name + " here";
}

// The error for a --style without a strength: "old", "old:1", "olld".
Error without_strength(const std::string& text, const Model& model) {
  if (text.starts_with('-')) {
    return Error{"--style: expected a name and a strength after it, found " +
                 panache::quoted(text)};
  }
  std::string name, note;
  for (const StyleInfo& style : model.styles()) {
    if (text.starts_with(style.name) && style.name.size() > name.size()) name = style.name;
  }
  if (name.empty()) {
    Result<int> style = model.find_style_by_any_name(text);
    if (!style) return style.error();
    note = note_of_word(text, model);
    name = note.empty() ? text : model.styles()[static_cast<size_t>(*style)].name;
  }
  return Error{"--style " + text + ": " + (note.empty() ? "" : note + "; ") +
               "expected a name and a strength, as in '" + name + "=1'"};
}

// Detects the common mistakes "1=old" and "old=1,proud=1".
Result<void> check_order(const std::string& text, const std::string& name, const std::string& value,
                         const Model& model) {
  if (!model.find_style_by_any_name(name) && parse_number(name) &&
      model.find_style_by_any_name(value)) {
    return Error{"--style " + text + ": expected the name before the strength, as in '" + value +
                 "=" + name + "'"};
  }
  const size_t second = value.find('=');
  const size_t end = value.find_first_of(",;+ ");
  if (second != std::string::npos && end < second) {
    return Error{"--style " + text + ": expected one style; the others go with an option each, " +
                 "as in --style " + name + "=" + value.substr(0, end) + " --style " +
                 value.substr(value.find_first_not_of(",;+ ", end))};
  }
  return {};
}

// "NAME=STRENGTH" or "NAME=STRENGTH..STRENGTH".
Result<StrengthWish> parse_style(const std::string& text, const Model& model) {
  const size_t equals = text.find('=');
  if (equals == std::string::npos) return without_strength(text, model);
  const std::string name = text.substr(0, equals), value = text.substr(equals + 1);
  if (auto order = check_order(text, name, value, model); !order) return order.error();
  Result<int> style = model.find_style_by_any_name(name);
  if (!style) return style.error();
  if (const std::string note = note_of_word(name, model); !note.empty()) print_message(note);
  const size_t dots = value.find("..");
  const std::string begin = value.substr(0, dots);
  const std::string end = dots == std::string::npos ? begin : value.substr(dots + 2);
  const std::optional<float> from = parse_strength(begin), to = parse_strength(end);
  if (!from || !to) {
    return Error{"--style " + text + ": " + kExpectedStrength +
                 " or a change such as '1..0', found " + panache::quoted(value)};
  }
  if (dots == std::string::npos) return StrengthWish{{*style, {{0, *from}}}, false};
  return StrengthWish{{*style, {{0, *from}, {1, *to}}}, true};
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
  return text;
}

// The columns of a table: which style each holds, and which one holds the seconds.
struct StrengthColumns {
  size_t seconds = 0;
  std::vector<int> styles;  // [columns], -1 for the seconds.
};
Result<StrengthColumns> read_columns(const CsvTable& table, const std::string& where,
                                     const Model& model) {
  std::vector<std::string> names;
  std::string list;
  for (const std::string& column : table.columns) {
    names.emplace_back(trimmed(column));
    if (names.size() > 1) list += ',';
    list += names.back();
  }
  StrengthColumns out;
  out.seconds =
      static_cast<size_t>(std::find(names.begin(), names.end(), "seconds") - names.begin());
  if (out.seconds == names.size() || names.size() < 2) {
    return Error{where + "expected the columns 'seconds' and one or more styles, found " +
                 panache::quoted(list)};
  }
  for (size_t c = 0; c < names.size(); ++c) {
    if (std::count(names.begin(), names.end(), names[c]) > 1) {
      return Error{where + "column " + panache::quoted(names[c]) + " is there twice"};
    }
    Result<int> style = c == out.seconds ? Result<int>(-1) : model.find_style_by_any_name(names[c]);
    if (!style) return Error{where + style.error().message, style.error().kind};
    out.styles.push_back(*style);
  }
  return out;
}

}  // namespace

std::optional<double> parse_number(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0;
  const char *begin = text.data(), *end = begin + text.size();
  const auto [stop, failure] = fast_float::from_chars(begin, end, value);
  if (failure != std::errc() || stop != end || !std::isfinite(value)) return std::nullopt;
  return value;
}

Error missing_style(const std::vector<std::string>& files, const Model& model) {
  for (const std::string& file : files) {
    const size_t equals = file.find('=');
    std::error_code status;
    if (!model.find_style_by_any_name(file.substr(0, equals)) ||
        std::filesystem::exists(file, status))
      continue;
    return Error{file + ": there is no such file; a style is given as --style " + file +
                 (equals == std::string::npos ? "=1" : "")};
  }
  std::vector<std::string> names;
  for (const StyleInfo& style : model.styles()) names.push_back(style.name);
  if (names.empty())
    return Error{"a style is missing; the model has no styles yet", ErrorKind::no_styles};
  constexpr size_t kListed = 12;
  const size_t more = names.size() - std::min(names.size(), kListed);
  names.resize(names.size() - more);
  std::string list = one_of(names, more ? ", " : " and ");
  if (more) list += " and " + std::to_string(more) + " more (panache styles lists all)";
  return Error{"a style is missing; expected one, as in --style " + names[0] +
               "=1, or a table of strengths (--strengths); the model has " + list};
}

Result<std::vector<StrengthWish>> parse_styles(const std::vector<std::string>& texts,
                                               const Model& model) {
  std::vector<StrengthWish> wishes;
  for (const std::string& text : texts) {
    Result<StrengthWish> wish = parse_style(text, model);
    if (!wish) return wish.error();
    for (const StrengthWish& other : wishes) {
      if (other.track.style == wish->track.style) {
        return Error{"--style " + text +
                     ": this style has a strength already; expected each "
                     "style once"};
      }
    }
    wishes.push_back(*std::move(wish));
  }
  return wishes;
}

Result<std::vector<StrengthWish>> read_strengths(const std::string& path, const Model& model) {
  Result<CsvTable> table = read_csv(path);
  if (!table) return table.error();
  Result<StrengthColumns> columns = read_columns(*table, path + ":1: ", model);
  if (!columns) return columns.error();
  if (table->rows.empty()) return Error{path + ": expected a line of strengths, found none"};
  std::vector<StrengthWish> wishes;
  for (const int style : columns->styles) {
    if (style >= 0) wishes.push_back({{style, {}}, false});
  }
  double before = -INFINITY;
  for (const CsvRow& row : table->rows) {
    const std::string where = path + ":" + std::to_string(row.line) + ": ";
    const std::string_view time = trimmed(row.values[columns->seconds]);
    const std::optional<double> seconds = parse_number(time);
    if (!seconds)
      return Error{where + "expected a number of seconds, found " + panache::quoted(time)};
    if (*seconds < before) {
      return Error{where + "expected seconds that rise from line to line, found " +
                   panache::quoted(time) + " after a later time"};
    }
    before = *seconds;
    size_t next = 0;
    for (size_t c = 0; c < row.values.size(); ++c) {
      if (columns->styles[c] < 0) continue;
      const std::string_view cell = trimmed(row.values[c]);
      const std::optional<float> strength = parse_strength(cell);
      if (!strength) {
        return Error{where + kExpectedStrength + " in column " +
                     panache::quoted(trimmed(table->columns[c])) + ", found " +
                     panache::quoted(cell)};
      }
      wishes[next++].track.points.push_back({*seconds, *strength});
    }
  }
  return wishes;
}

std::vector<StrengthTrack> tracks_for(const std::vector<StrengthWish>& wishes, double first,
                                      double last) {
  std::vector<StrengthTrack> tracks;
  for (const StrengthWish& wish : wishes) {
    tracks.push_back(wish.track);
    if (!wish.over_clip) continue;
    for (StrengthTrack::Point& point : tracks.back().points) {
      point.seconds = first + point.seconds * (last - first);
    }
  }
  return tracks;
}

std::string describe(const StrengthWish& wish) {
  const std::vector<StrengthTrack::Point>& points = wish.track.points;
  const auto text = [](const StrengthTrack::Point& point) {
    return brief(static_cast<double>(point.strength));
  };
  const bool constant = std::all_of(points.begin(), points.end(), [&](const auto& point) {
    return point.strength == points.front().strength;
  });
  if (constant) return text(points.front());
  return wish.over_clip ? text(points.front()) + ".." + text(points.back()) : "varies";
}

}  // namespace panache::cli
