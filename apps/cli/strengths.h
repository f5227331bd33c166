#pragma once
// The requested styles and their strengths, from the command line or a table.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "style/model/model.h"
#include "style/restyle.h"

namespace panache::cli {

// The stylizer's range of strengths.
inline constexpr float kLowestStrength = -4, kHighestStrength = 4;

// `text` as a finite number; none if other characters follow.
std::optional<double> parse_number(std::string_view text);

// A strength track whose times may be relative to a clip that is not known yet.
struct StrengthWish {
  StrengthTrack track;
  bool over_clip = false;  // The times are shares of the clip, 0 to 1, not seconds.
};

// The error if no style is requested: explains the option and lists the styles. `files`: the input
// files; a style name among them lacks its option.
Error missing_style(const std::vector<std::string>& files, const Model& model);

// Reads "old=1" and "old=1..0" (from the first to the last frame).
Result<std::vector<StrengthWish>> parse_styles(const std::vector<std::string>& texts,
                                               const Model& model);

// Reads a CSV with a column `seconds` (input time, increasing) and one column per style.
Result<std::vector<StrengthWish>> read_strengths(const std::string& path, const Model& model);

// The tracks for a clip that lasts from `first` to `last` seconds.
std::vector<StrengthTrack> tracks_for(const std::vector<StrengthWish>& wishes, double first,
                                      double last);

// A short form for file names: "1", "1..0", "varies" (changed by a table).
std::string describe(const StrengthWish& wish);

}  // namespace panache::cli
