#include "style/model/names.h"

#include <algorithm>

#include "pose/features.h"
#include "rig/humanoid.h"

namespace panache {

std::string canonical_joint_list() {
  std::string list;
  for (int j = 0; j < kHumanJoints; ++j) {
    if (j) list += ' ';
    list += human_joint_name(j);
  }
  return list;
}

std::string window_description() {
  static_assert(kWindowPoses == 6 && kWindowSpacing == 0.05);
  return "6 poses 0.05 s apart";
}

// Without streams, which would add all locales of the library to the page's module.
std::vector<std::string> split_lines(std::string_view text) {
  std::vector<std::string> lines;
  while (!text.empty()) {
    const size_t end = std::min(text.find('\n'), text.size());
    lines.emplace_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return lines;
}

}  // namespace panache
