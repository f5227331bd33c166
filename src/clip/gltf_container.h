#pragma once
// The outside of a glTF file: GLB chunks or JSON text, and the buffers that it brings along or
// points to. Private to the folder.

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "clip/gltf_json.h"

namespace panache {

struct GltfContainer {
  size_t size = 0;       // Bytes of the file and of what it points to.
  bool binary = false;   // GLB; else JSON text.
  bool has_bin = false;  // The GLB's own chunk is the first buffer.
  GltfJson json;
  // [buffers] the bytes, byteLength of them; none where an extension has to provide them.
  std::vector<std::optional<std::string>> buffers;
  std::vector<std::pair<uint32_t, std::string>> other_chunks;  // Type and bytes, as they came.
  int indent = -1;  // Of JSON text; -1 for a single line.
  char indent_char = ' ';

  // The bytes that a part of the JSON names by buffer, byteOffset and byteLength; none where it is
  // wrong.
  std::string_view bytes_of(const GltfPart& view) const;
};

// Reads a file's bytes. What it points to in other files is read as well (beside and below the
// file that `name` is the path of, nowhere else), and its address in the JSON becomes a data URI,
// so that the result stands alone wherever it is written.
bool read_gltf_container(std::string bytes, const std::string& name, GltfChecker& checker,
                         GltfContainer& out);

// The file again, with `json` in place of its own and `added` at the end of its binary data; the
// caller has described the added bytes in `json`. They begin where gltf_added_at() says.
std::string write_gltf_container(const GltfContainer& container, GltfJson json,
                                 const std::string& added);

// Where bytes that are added to the file go: which buffer, and from which byte of it on.
struct GltfPlace {
  size_t buffer = 0;
  size_t offset = 0;  // A multiple of 4.
};
GltfPlace gltf_added_at(const GltfContainer& container);

// gltf_accessor.cpp: numbers in the binary data.
struct GltfValues {
  size_t count = 0;            // Elements.
  size_t components = 0;       // Numbers in an element, 1 to 4; 16 of a matrix.
  std::vector<float> numbers;  // [count][components], finite and within kLargestNumber.
};

// Reads accessor `which` of a file, which exists; `path` is where it is asked for, and a failure's
// place. Whole numbers come as the fractions that they stand for where the accessor is normalised.
// Reading takes at most a few times the memory of the file.
bool read_gltf_accessor(const GltfContainer& container, int which, const std::string& path,
                        GltfChecker& checker, GltfValues& out);

// The same for matrices of floats (MAT4), columns one after the other; nothing else is accepted.
bool read_gltf_matrices(const GltfContainer& container, int which, const std::string& path,
                        GltfChecker& checker, GltfValues& out);

// gltf_unpack.cpp: files without packed data.

// The extension that packs a view of data, or null.
const char* gltf_packing(const GltfPart& view);

// Whether some data of the file is packed, and can be decoded (meshopt.h).
bool has_packed_data(const GltfContainer& container);
// Whether keys of its animations are.
bool has_packed_motion(const GltfContainer& container);

// The same file in one buffer, in which all data is plain. `checker` says what cannot be decoded.
bool unpack_gltf(const GltfContainer& container, GltfChecker& checker, GltfContainer& out);

}  // namespace panache
