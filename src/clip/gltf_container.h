#pragma once
// The outside of a glTF file: GLB chunks or JSON text, and embedded or referenced buffers. Private
// to the folder.

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "clip/gltf_json.h"

namespace panache {

struct GltfContainer {
  size_t size = 0;       // Bytes of the file and of the files that it refers to.
  bool binary = false;   // GLB; else JSON text.
  bool has_bin = false;  // The GLB's own chunk is the first buffer.
  GltfJson json;
  // [buffers] byteLength bytes each; none if an extension has to provide them.
  std::vector<std::optional<std::string>> buffers;
  std::vector<std::pair<uint32_t, std::string>> other_chunks;  // Type and bytes, unchanged.
  int indent = -1;  // Indentation of JSON text; -1 for a single line.
  char indent_char = ' ';

  // The bytes that a part of the JSON refers to by buffer, byteOffset and byteLength; none if it is
  // invalid.
  std::string_view bytes_of(const GltfPart& view) const;
};

// Reads a file's bytes. Files that it refers to are read as well (only in the folder of `name`, the
// file's path, and below), and their addresses in the JSON become data URIs, so that the result is
// self-contained.
bool read_gltf_container(std::string bytes, const std::string& name, GltfChecker& checker,
                         GltfContainer& out);

// The file with `json` in place of its own and `added` at the end of its binary data; the caller
// has described the added bytes in `json`. They begin where gltf_added_at() says.
std::string write_gltf_container(const GltfContainer& container, GltfJson json,
                                 const std::string& added);

// Where bytes that are added to the file go: the buffer and the offset in it.
struct GltfPosition {
  size_t buffer = 0;
  size_t offset = 0;  // A multiple of 4.
};
GltfPosition gltf_added_at(const GltfContainer& container);

// gltf_accessor.cpp: numbers in the binary data.
struct GltfValues {
  size_t count = 0;            // Elements.
  size_t components = 0;       // Numbers in an element: 1 to 4, or 16 for a matrix.
  std::vector<float> numbers;  // [count][components], finite and within kLargestNumber.
};

// Reads accessor `which` of a file, which exists; errors name `path`, which refers to it. Integers
// of a normalised accessor are converted to the fractions that they stand for. Reading takes at
// most a few times the memory of the file.
bool read_gltf_accessor(const GltfContainer& container, int which, const std::string& path,
                        GltfChecker& checker, GltfValues& out);

// The same for matrices of floats (MAT4), column-major; other types are rejected.
bool read_gltf_matrices(const GltfContainer& container, int which, const std::string& path,
                        GltfChecker& checker, GltfValues& out);

// gltf_unpack.cpp: unpacks files.

// The extension that packs a view of data, or null.
const char* gltf_packing(const GltfPart& view);

// Whether the file has packed data that can be decoded (MeshoptDecoder in gltf.h).
bool has_packed_data(const GltfContainer& container);
// Whether keys of its animations are packed.
bool has_packed_motion(const GltfContainer& container);

// The same file with one buffer of unpacked data. `checker` reports what cannot be decoded.
bool unpack_gltf(const GltfContainer& container, GltfChecker& checker, GltfContainer& out);

}  // namespace panache
