#pragma once
// Names that model files carry.

#include <string>

namespace panache {

// "hips spine chest ...": the canonical joints in their order, as model files carry them.
std::string canonical_joint_list();
// "6 poses 0.05 s apart", as model files carry it.
std::string window_description();

// A remover is a model whose input shows a style and whose output is neutral: its metadata
// kDirection is kRemove, and each of its styles takes off the style of that name. kAnyStyle is the
// one for motion in an unknown style.
inline constexpr const char* kDirection = "direction";
inline constexpr const char* kRemove = "remove";
inline constexpr const char* kAnyStyle = "any";

}  // namespace panache
