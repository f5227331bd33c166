#pragma once
// Names that people type and model files carry.

#include <string>
#include <string_view>
#include <vector>

namespace panache {

// "hips spine chest ...": the canonical joints in their order, as model files carry them.
std::string canonical_joint_list();
// "6 poses 0.05 s apart", as model files carry it.
std::string window_description();

// The `count` of `names` nearest to `wanted` by edit distance, as "old, proud and sad".
std::string list_nearest(std::string_view wanted, const std::vector<std::string>& names, int count);

}  // namespace panache
