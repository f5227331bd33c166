#pragma once
// GLB files as bytes: what has to change about them on the way in and out, motion apart.

#include <string>

#include "base/result.h"

namespace panache::cli {

// `glb` with every picture's address such that the file at `path` can have it: below that file's
// folder, or by its bare name beside it; a white pixel in the place of those that are nowhere.
// Bytes that are no UTF-8 become U+FFFD, which JSON wants. Without
// KHR_materials_pbrSpecularGlossiness, an extension that is no longer supported.
std::string with_pictures(std::string glb, const std::string& path);

// The GLB of a .gltf that stands alone: what it holds in data URIs goes into the binary chunk.
// Rejected, with `path` in front, is a buffer that only an extension can provide.
Result<std::string> gltf_to_glb(const std::string& gltf, const std::string& path);

}  // namespace panache::cli
