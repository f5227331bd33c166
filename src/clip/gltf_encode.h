#pragma once
// MotionFile::encode for a glTF file, and the pieces of JSON that describe new data. Private to the
// folder.

#include <span>
#include <string>
#include <string_view>

#include "clip/gltf_document.h"
#include "clip/motion_file.h"

namespace panache {

std::string encode_gltf(const GltfDocument& document, std::span<const ClipEdit> edits,
                        EditMode mode);

// Appends new numbers to a file's binary data, and their accessors to its JSON. All numbers of one
// writer share a buffer view.
class GltfDataWriter {
 public:
  // Appends to `bytes`, which begin at `added_at` in the file; both outlive the writer.
  GltfDataWriter(GltfPosition added_at, GltfJson& json, std::string& bytes)
      : added_at_(added_at), json_(json), bytes_(bytes) {}

  // Adds an accessor of floats of `type` ("SCALAR", "VEC3", ...), with min and max if `bounds`;
  // returns its index in the file.
  size_t add(std::span<const float> numbers, std::string_view type, size_t components,
             bool bounds = false);
  // Adds the accessor of the times of frames, seconds.
  size_t add_times(double start, double frame_time, int frames);

 private:
  GltfPosition added_at_;
  GltfJson& json_;
  std::string& bytes_;
  int view_ = -1;     // Made with the first numbers.
  size_t first_ = 0;  // Where in `bytes` the view begins.
};

}  // namespace panache
