#include "style/names.h"

#include <algorithm>
#include <numeric>

#include "pose/features.h"
#include "rig/humanoid.h"

namespace panache {
namespace {

// Levenshtein's distance: the fewest letters to add, drop or replace. Ten times as dear when
// neither name begins with the other's first two letters, so that "ang" finds "angry" before "old".
int edit_distance(std::string_view a, std::string_view b) {
  std::vector<int> row(b.size() + 1);
  std::iota(row.begin(), row.end(), 0);
  for (size_t i = 1; i <= a.size(); ++i) {
    int diagonal = row[0];
    row[0] = static_cast<int>(i);
    for (size_t j = 1; j <= b.size(); ++j) {
      const int replace = diagonal + (a[i - 1] != b[j - 1]);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, replace});
    }
  }
  return row.back() * (a.substr(0, 2) == b.substr(0, 2) ? 1 : 10);
}

}  // namespace

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

std::string list_nearest(std::string_view wanted, const std::vector<std::string>& names,
                         int count) {
  std::vector<std::string> sorted = names;
  std::stable_sort(sorted.begin(), sorted.end(), [&](const auto& a, const auto& b) {
    return edit_distance(wanted, a) < edit_distance(wanted, b);
  });
  sorted.resize(std::min(sorted.size(), static_cast<size_t>(count)));
  std::string list;
  for (size_t i = 0; i < sorted.size(); ++i) {
    if (i) list += i + 1 == sorted.size() ? " and " : ", ";
    list += sorted[i];
  }
  return list;
}

}  // namespace panache
