#pragma once
// Splits a joint's name into words and side, for the naming of any tool: "mixamorig:LeftHand",
// "Bip01 L Hand", "hand.L", "lHand".

#include <string>
#include <string_view>
#include <vector>

namespace panache {

enum class Side { none, left, right };

struct JointName {
  Side side = Side::none;
  std::vector<std::string> words;  // Lower case, in order, without the side; numbers are words too.

  bool has(std::string_view word) const;
};

// Splits `name` at its last colon or bar (the part before is a namespace), then at everything that
// is not a letter or digit, between lower and upper case and between letters and digits. Of a name
// of more than 100 letters, the last 100 count.
JointName parse_joint_name(std::string_view name);

// The words without a trailing number, which counts the pieces of a limb ("forearm", "001").
std::vector<std::string> without_number(const std::vector<std::string>& words);

}  // namespace panache
