#pragma once
// Numbers in the binary data of a glTF file. Private to the folder.

#include <string>
#include <vector>

#include "clip/gltf_container.h"

namespace panache {

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

}  // namespace panache
