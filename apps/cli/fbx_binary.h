#pragma once
// FBX 6 in binary form, brought to the text form that says the same.

#include <string>
#include <string_view>

#include "base/result.h"

namespace panache::cli {

// Whether a file begins as binary FBX does; its version, as in 6100, or 0 where it does not.
int binary_fbx_version(std::string_view bytes);

// The text form of a binary file of a version below 7000: later ones, which compress their arrays,
// are Assimp's. Every length is checked against the bytes there are; `path` stands in front of the
// messages.
Result<std::string> fbx_text_of(std::string_view bytes, const std::string& path);

}  // namespace panache::cli
