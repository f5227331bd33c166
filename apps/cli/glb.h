#pragma once
// GLB files as bytes: what has to change about them on the way in and out, motion apart.

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"

namespace panache::cli {

// `text` as an address has it, which has its own way to write all but plain letters, digits and
// `plain`.
std::string percent_encoded(const std::string& text, std::string_view plain);

// The PNG of a picture of another kind, such as TGA; the message of a failure says what the kinds
// are.
using PictureToPng = std::function<Result<std::string>(const std::string& picture)>;

// `glb`, which Assimp made of the file at `path`, with pictures and materials as glTF wants them:
// - Pictures outside of it are addressed below that file's folder: at their own path, or at an end
//   of that path. Those that are no PNG or JPEG become PNG by `to_png`. Those that are nowhere, or
//   of no known kind, are taken out of their materials, and `notes` names each.
// - A texture counts alone, as in FBX: the colour that glTF multiplies it by is white.
// - Bytes that are no UTF-8 become U+FFFD, which JSON wants; KHR_materials_pbrSpecularGlossiness,
//   an extension that is no longer supported, goes.
std::string with_pictures(std::string glb, const std::string& path, const PictureToPng& to_png,
                          std::vector<std::string>& notes);

// The GLB of a .gltf that stands alone: what it holds in data URIs goes into the binary chunk.
// Rejected, with `path` in front, is a buffer that only an extension can provide.
Result<std::string> gltf_to_glb(const std::string& gltf, const std::string& path);

}  // namespace panache::cli
