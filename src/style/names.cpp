#include "style/names.h"

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

}  // namespace panache
