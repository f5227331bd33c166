#pragma once
// Names that model files carry.

#include <string>

namespace panache {

// "hips spine chest ...": the canonical joints in their order, as model files carry them.
std::string canonical_joint_list();
// "6 poses 0.05 s apart", as model files carry it.
std::string window_description();

}  // namespace panache
