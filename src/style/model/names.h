#pragma once
// Names that model files carry.

#include <string>
#include <string_view>
#include <vector>

namespace panache {

// "hips spine chest ...": the canonical joints in their order, as model files carry them.
std::string canonical_joint_list();
// "6 poses 0.05 s apart", as model files carry it.
std::string window_description();

// The lines of a list in a model file's metadata.
std::vector<std::string> split_lines(std::string_view text);

// A remover is a model with styled input and neutral output: its metadata kDirection is kRemove,
// and each of its styles takes off the style of that name, kAnyStyle an unknown one.
inline constexpr const char* kDirection = "direction";
inline constexpr const char* kRemove = "remove";
inline constexpr const char* kAnyStyle = "any";

}  // namespace panache
