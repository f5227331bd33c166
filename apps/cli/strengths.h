#pragma once
// Which styles the user wants, and how strongly, from the command line or from a table.

#include <string>
#include <vector>

#include "base/result.h"
#include "style/model.h"
#include "style/restyle.h"

namespace panache::cli {

// What the stylizer holds strengths to.
inline constexpr float kLowestStrength = -4, kHighestStrength = 4;

// A strength track whose times may have to wait for a clip.
struct StrengthWish {
  StrengthTrack track;
  bool over_clip = false;  // The times are shares of the clip, 0 to 1, not seconds.
};

// What to say where no style is asked for: how that is done, and which styles there are. `files`:
// the input files; a style among them lacks its option.
Error missing_style(const std::vector<std::string>& files, const Model& model);

// Reads "old=1" and "old=1..0" (from the first to the last frame).
Result<std::vector<StrengthWish>> parse_styles(const std::vector<std::string>& texts,
                                               const Model& model);

// Reads a CSV with a column `seconds` (of the input, rising) and one column per style.
Result<std::vector<StrengthWish>> read_strengths(const std::string& path, const Model& model);

// The wishes for a clip that moves from `first` to `last` seconds.
std::vector<StrengthTrack> tracks_for(const std::vector<StrengthWish>& wishes, double first,
                                      double last);

// A wish in a few letters, for names: "1", "1..0", "varies" (a table that changes it).
std::string describe(const StrengthWish& wish);

}  // namespace panache::cli
