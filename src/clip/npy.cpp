#include "clip/npy.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <system_error>

#include "base/bytes.h"
#include "clip/text_cursor.h"

namespace panache {
namespace {

constexpr std::string_view kMagic = "\x93NUMPY";
constexpr size_t kMaxDimensions = 8;

// Bytes of an element; 0 for an unsupported type.
size_t size_of(std::string_view type) {
  if (type.size() < 3 || type.size() > 6) return 0;
  if (std::string_view("<>|=").find(type[0]) == std::string_view::npos) return 0;
  if (std::string_view("bifuSU").find(type[1]) == std::string_view::npos) return 0;
  size_t size = 0;
  for (const char c : type.substr(2)) {
    if (c < '0' || c > '9') return 0;
    size = 10 * size + (c - '0');
  }
  return type[1] == 'U' ? 4 * size : size;
}

// Parses "{'descr': '<f8', 'fortran_order': False, 'shape': (2, 3), }".
Result<void> read_header(std::string_view text, const std::string& name, NpyArray& out) {
  const auto value_of = [&](std::string_view key) {
    const size_t at = text.find(key);
    const size_t begin = at == text.npos ? at : text.find_first_not_of("'\": \n", at + key.size());
    return begin == text.npos ? std::string_view() : text.substr(begin);
  };
  const std::string_view type = value_of("descr"), shape = value_of("shape");
  out.type = type.substr(0, type.find_first_of("'\""));
  out.by_columns = value_of("fortran_order").starts_with("True");
  bool good = !type.empty() && shape.starts_with('(') && shape.find(')') != shape.npos;
  std::string_view sizes = good ? shape.substr(1, shape.find(')') - 1) : "";
  for (size_t at; good && (at = sizes.find_first_not_of(", ")) != sizes.npos;) {
    constexpr uint64_t kLargest = uint64_t{1} << 50;  // No file is larger.
    uint64_t size = 0;
    const char* const end = sizes.data() + sizes.size();
    const auto [after, failure] = std::from_chars(sizes.data() + at, end, size);
    good = failure == std::errc() && size < kLargest && out.shape.size() < kMaxDimensions;
    out.shape.push_back(size);
    sizes.remove_prefix(after - sizes.data());
    good = good && (sizes.empty() || sizes.front() == ',' || sizes.front() == ' ');
  }
  if (!good) {
    return Error{name + ": expected descr, fortran_order and at most 8 sizes as shape in the " +
                 "header of an array, found " + quoted(text)};
  }
  if (size_of(out.type) > 0) return {};
  return Error{name + ": expected an array of numbers or text, found the type " + quoted(out.type)};
}

double number_at(const char* bytes, char kind, size_t size, bool swap) {
  std::string in(bytes, size);
  if (swap) std::reverse(in.begin(), in.end());
  const uint64_t bits = little_endian(in);
  if (kind == 'f' && size == 8) return std::bit_cast<double>(bits);
  if (kind == 'f') return static_cast<double>(std::bit_cast<float>(static_cast<uint32_t>(bits)));
  if (kind != 'i' || size == 8) {
    return kind == 'i' ? static_cast<double>(static_cast<int64_t>(bits))
                       : static_cast<double>(bits);
  }
  const uint64_t sign = uint64_t{1} << (8 * size - 1);
  return static_cast<double>(static_cast<int64_t>(bits ^ sign) - static_cast<int64_t>(sign));
}

}  // namespace

size_t NpyArray::count() const {
  size_t product = 1;
  for (const size_t size : shape) product *= size;
  return product;
}

Result<NpyArray> parse_npy(std::string_view bytes, const std::string& name) {
  if (!bytes.starts_with(kMagic) || bytes.size() < 12) {
    return Error{name + ": expected an array as numpy.save writes it, found " +
                 quoted(bytes.substr(0, 8))};
  }
  const int version = bytes[6];
  if (version < 1 || version > 3) {
    return Error{name + ": expected version 1, 2 or 3 of numpy's format, found " +
                 std::to_string(version)};
  }
  const size_t field = version == 1 ? 2 : 4, begin = 8 + field;
  const uint64_t length = little_endian(bytes.substr(8, field));
  if (length > bytes.size() - begin) {
    return Error{name + ": expected a header of " + std::to_string(length) + " bytes, found " +
                 std::to_string(bytes.size() - begin) + " to the end"};
  }
  NpyArray out;
  if (auto done = read_header(bytes.substr(begin, length), name, out); !done) return done.error();
  out.elements = bytes.substr(begin + length);
  // Compares without a product that might overflow.
  size_t left = out.elements.size() / size_of(out.type);
  const bool none = std::find(out.shape.begin(), out.shape.end(), size_t{0}) != out.shape.end();
  for (const size_t size : out.shape) left = none ? 0 : left / size;
  const bool enough = none || left > 0;
  if (enough && out.elements.size() == out.count() * size_of(out.type)) return out;
  return Error{name + ": expected as many bytes as its shape says, found " +
               std::to_string(out.elements.size())};
}

std::string format_npy(const NpyArray& array) {
  std::string shape;
  for (const size_t size : array.shape) shape += std::to_string(size) + ", ";
  // A single dimension keeps its comma: "(5,)".
  if (array.shape.size() > 1) shape.resize(shape.size() - 2);
  if (array.shape.size() == 1) shape.pop_back();
  std::string header = "{'descr': '" + array.type +
                       "', 'fortran_order': " + (array.by_columns ? "True" : "False") +
                       ", 'shape': (" + shape + "), }";
  // Padded to a multiple of 64 bytes, as numpy requires.
  const size_t unpadded = 10 + header.size() + 1;
  header.append((unpadded + 63) / 64 * 64 - unpadded, ' ');
  header += '\n';
  std::string out(kMagic);
  out += {'\1', '\0'};
  append_little_endian(header.size(), 2, out);
  return out + header + array.elements;
}

Result<std::vector<double>> npy_numbers(const NpyArray& array, const std::string& name) {
  const char kind = array.type[1];
  const size_t size = size_of(array.type);
  const bool readable =
      kind == 'f' ? size == 4 || size == 8
                  : (kind == 'i' || kind == 'u') && std::has_single_bit(size) && size <= 8;
  if (!readable) {
    return Error{name + ": expected floats of 4 or 8 bytes or whole numbers, found the type " +
                 quoted(array.type)};
  }
  const size_t count = array.count();
  std::vector<double> in_file(count);
  for (size_t i = 0; i < count; ++i) {
    in_file[i] = number_at(&array.elements[i * size], kind, size, array.type[0] == '>');
    if (std::abs(in_file[i]) <= kLargestNumber) continue;
    return Error{name + ": expected numbers between -1e9 and 1e9, found one outside or NaN"};
  }
  if (!array.by_columns || array.shape.size() != 2) return in_file;
  std::vector<double> out(count);
  const size_t rows = array.shape[0], columns = array.shape[1];
  for (size_t r = 0; r < rows; ++r) {
    for (size_t c = 0; c < columns; ++c) out[r * columns + c] = in_file[c * rows + r];
  }
  return out;
}

NpyArray npy_array(std::span<const double> numbers, std::vector<size_t> shape,
                   const std::string& type) {
  const bool single = type == "<f4";
  NpyArray out{single ? "<f4" : "<f8", false, std::move(shape), {}};
  assert(out.count() == numbers.size());
  for (const double number : numbers) {
    const uint64_t bits = single ? std::bit_cast<uint32_t>(static_cast<float>(number))
                                 : std::bit_cast<uint64_t>(number);
    append_little_endian(bits, single ? 4 : 8, out.elements);
  }
  return out;
}

}  // namespace panache
