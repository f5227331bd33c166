#pragma once
// The tables of clips before the judges of performers, for the terminal.

#include <string>
#include <utility>
#include <vector>

#include "eval/report.h"

namespace panache {

struct ClipCell {
  double value = kNotMeasured;
  int digits = 0;
  bool is_share = false;  // 0 to 1.
};
// A name per row, and cells right of it in groups of columns. Without rows there is no table.
struct ClipTable {
  std::string names;                                                     // What the rows are.
  std::vector<std::pair<std::string, std::vector<std::string>>> groups;  // Heading, columns.
  std::vector<std::pair<std::string, std::vector<ClipCell>>> rows;
};

// A row per style, then all of them: real takes, and each system's outputs.
ClipTable own_clips_table(const Report& report);
// The same of motion of performers who are not those of the style, and of shared styles.
ClipTable clips_across_table(const Report& report);
// A row per unseen content, then all of them.
ClipTable unseen_clips_table(const UnseenReport& split);

}  // namespace panache
