#pragma once
// GLB files as bytes: changes needed on input and output, apart from motion.

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"

namespace panache::cli {

// Percent-encodes `text` for a URI, except for ASCII letters, digits and the characters in `plain`.
std::string percent_encoded(const std::string& text, std::string_view plain);

// Converts a picture of another kind, such as TGA, to PNG; the error message lists the supported
// kinds.
using PictureToPng = std::function<Result<std::string>(const std::string& picture)>;

// `glb`, which Assimp made from the file at `path`, with pictures and materials as glTF requires:
// - External pictures are looked up below that file's folder: at their full path, or at the end of
//   that path. `to_png` converts all but PNG and JPEG. Missing and unsupported pictures are removed
//   from their materials, and `notes` names each.
// - A texture replaces the colour in FBX, so the colour that glTF multiplies it by becomes white.
// - Invalid UTF-8 becomes U+FFFD, as JSON requires; KHR_materials_pbrSpecularGlossiness, an
//   extension that is no longer supported, is removed.
std::string with_pictures(std::string glb, const std::string& path, const PictureToPng& to_png,
                          std::vector<std::string>& notes);

// A self-contained .gltf as GLB: the content of its data URIs goes into the binary chunk. Rejects a
// buffer that only an extension can provide; the message begins with `path`.
Result<std::string> gltf_to_glb(const std::string& gltf, const std::string& path);

}  // namespace panache::cli
