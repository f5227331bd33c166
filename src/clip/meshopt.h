#pragma once
// Packed data in glTF files (EXT_meshopt_compression), which a program may decode.

#include <cstddef>
#include <string_view>

namespace panache {

enum class MeshoptMode { attributes, triangles, indices };
enum class MeshoptFilter { none, octahedral, quaternion, exponential };

// A packed part of a buffer, with values that the extension allows.
struct MeshoptView {
  MeshoptMode mode = MeshoptMode::attributes;
  MeshoptFilter filter = MeshoptFilter::none;  // For attributes only.
  size_t count = 0;                            // Elements, at least one; whole triangles.
  size_t stride = 0;  // Bytes of an element: attributes 4 to 256, a multiple of 4; indices 2 or 4.
};

// Decodes `packed`, which may be any bytes, to view.count * view.stride bytes at `out`; false if
// that fails.
using MeshoptDecoder = bool (*)(const MeshoptView& view, std::string_view packed, char* out);

// Sets the decoder of packed motion; null, the default, rejects packed motion. Called before any
// thread reads.
void set_meshopt_decoder(MeshoptDecoder decoder);

}  // namespace panache
