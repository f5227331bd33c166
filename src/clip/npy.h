#pragma once
// Numpy arrays (.npy): a text header, then the elements.

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"

namespace panache {

struct NpyArray {
  std::string type;           // Numpy's: "<f8", "<i4", "|S5", "<U7", ...
  bool by_columns = false;    // Fortran order; otherwise the last index runs fastest.
  std::vector<size_t> shape;  // Empty for a single value.
  std::string elements;       // The bytes, as many as type and shape say.

  size_t count() const;  // Elements: the product of the shape.
};

// Parses the bytes of a .npy file, versions 1 to 3. Error messages start with `name`. Arrays of
// records and of Python objects are rejected.
Result<NpyArray> parse_npy(std::string_view bytes, const std::string& name);
std::string format_npy(const NpyArray& array);

// The numbers of an array of floats or integers of either byte order, the last index fastest.
// Non-finite numbers and those beyond kLargestNumber are rejected.
Result<std::vector<double>> npy_numbers(const NpyArray& array, const std::string& name);
// The inverse: an array of "<f4" or "<f8"; any other type becomes "<f8".
NpyArray npy_array(std::span<const double> numbers, std::vector<size_t> shape,
                   const std::string& type);

}  // namespace panache
