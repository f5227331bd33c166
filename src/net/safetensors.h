#pragma once
// The safetensors container: named arrays of numbers, and text metadata.

#include <cstdint>
#include <limits>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"

namespace panache {

struct Tensor {
  std::vector<int64_t> shape;  // Row-major, last index fastest.
  std::vector<float> values;   // Product of the shape.
  bool half = false;           // Stored as 16-bit floats (F16) in the file; always float here.
  bool int8 = false;           // Stored as whole numbers from -128 to 127 (I8); not `half` then.
};

struct TensorFile {
  std::map<std::string, std::string> metadata;
  std::map<std::string, Tensor> tensors;
};

// The tensor `key`, if it has this shape (-1 for any size above zero) and its numbers are finite
// and smaller than `limit`. Error messages start with `name`.
Result<const Tensor*> find_tensor(const TensorFile& file, const std::string& key,
                                  const std::vector<int64_t>& shape, const std::string& name,
                                  float limit = std::numeric_limits<float>::infinity());

// Reads a safetensors file (types F32, F16 and I8). Every count is bounded by the available bytes.
// Error messages start with `name`.
Result<TensorFile> parse_safetensors(std::string_view bytes, const std::string& name);

// The bytes of a safetensors file: tensors and metadata sorted by name (F32 before F16 before I8),
// numbers aligned, so that the same contents always give the same bytes. Every tensor must have as
// many values as its shape says, at most 8 dimensions, and a name other than "__metadata__".
std::string format_safetensors(const TensorFile& file);

// IEEE half precision, rounded to nearest even. Finite numbers beyond the largest half become that
// (65504) instead of infinity; infinities and NaN stay what they are.
uint16_t to_half(float value);
float from_half(uint16_t bits);

}  // namespace panache
