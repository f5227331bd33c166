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

}  // namespace panache
