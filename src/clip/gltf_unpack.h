#pragma once
// glTF files without packed data. Private to the folder.

#include "clip/gltf_container.h"

namespace panache {

// The extension that packs a view of data, or null.
const char* gltf_packing(const GltfPart& view);

// Whether some data of the file is packed, and can be decoded (meshopt.h).
bool has_packed_data(const GltfContainer& container);
// Whether keys of its animations are.
bool has_packed_motion(const GltfContainer& container);

// The same file in one buffer, in which all data is plain. `checker` says what cannot be decoded.
bool unpack_gltf(const GltfContainer& container, GltfChecker& checker, GltfContainer& out);

}  // namespace panache
