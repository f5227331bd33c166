#include "clip/gltf_container.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <string_view>

#include "base/bytes.h"
#include "clip/text_cursor.h"

namespace panache {
namespace {

enum ComponentType : uint64_t {
  kInt8 = 5120,
  kUint8 = 5121,
  kInt16 = 5122,
  kUint16 = 5123,
  kUint32 = 5125,
  kFloat = 5126,
};

// Bytes of a component; 0 for an invalid type.
size_t component_bytes(uint64_t type) {
  switch (type) {
    case kInt8:
    case kUint8:
      return 1;
    case kInt16:
    case kUint16:
      return 2;
    case kUint32:
    case kFloat:
      return 4;
    default:
      return 0;
  }
}

float component(const char* bytes, uint64_t type, bool normalized) {
  const size_t size = component_bytes(type);
  const auto bits = static_cast<uint32_t>(little_endian({bytes, size}));
  if (type == kFloat) return std::bit_cast<float>(bits);
  const bool is_signed = type == kInt8 || type == kInt16;
  const uint64_t largest = (uint64_t{1} << (8 * size - is_signed)) - 1;
  double value = bits;
  if (type == kInt8) value = static_cast<int8_t>(bits);
  if (type == kInt16) value = static_cast<int16_t>(bits);
  if (normalized) value /= static_cast<double>(largest);
  // Both of the two lowest signed integers stand for -1.
  return static_cast<float>(normalized ? std::max(value, -1.0) : value);
}

class AccessorReader {
 public:
  AccessorReader(const GltfContainer& container, int which, const std::string& asked_at,
                 GltfChecker& checker, bool matrices)
      : container_(container),
        root_(container.json, checker),
        accessor_(root_.item("accessors", which)),
        asked_at_(asked_at),
        checker_(checker),
        matrices_(matrices) {}

  bool read(GltfValues& out) {
    if (!read_layout(out)) return false;
    const int view = accessor_.index("bufferView", root_.size("bufferViews"));
    const GltfPart sparse = accessor_.object("sparse");
    if (!checker_.ok()) return false;
    if (view < 0 && out.count > bytes_of_file()) {
      // Zeros take no bytes; only the size of the file bounds their number.
      return fail("expected fewer zeros than the file has bytes, found " +
                  std::to_string(out.count));
    }
    Elements elements;
    if (view >= 0 && !find_elements(accessor_, view, out.count, size_of(out), elements)) {
      return false;
    }
    // A stride is at least a component here, and the elements lie within the buffer, which bounds
    // the allocation.
    out.numbers.assign(out.count * out.components, 0.0f);
    for (size_t i = 0; view >= 0 && i < out.count; ++i) put(elements.at(i), i, out);
    return (!sparse || read_sparse(sparse, out)) && check_numbers(out);
  }

 private:
  struct Elements {
    const char* first = nullptr;
    size_t stride = 0;
    const char* at(size_t i) const { return first + i * stride; }
  };

  // Reports an error in this accessor, at the path that refers to it.
  bool fail(const std::string& message) {
    return checker_.fail(asked_at_ + " (" + accessor_.path() + ")", message);
  }

  size_t bytes_of_file() const {
    size_t bytes = 0;
    for (const auto& buffer : container_.buffers) bytes += buffer ? buffer->size() : 0;
    return bytes;
  }

  bool read_layout(GltfValues& out) {
    out.count = accessor_.count("count");
    type_ = accessor_.count("componentType");
    normalized_ = accessor_.flag("normalized");
    const std::string shape = accessor_.text("type");
    if (!checker_.ok()) return false;
    if (component_bytes(type_) == 0) {
      return fail("expected a componentType of 5120 to 5126, found " + std::to_string(type_));
    }
    constexpr std::string_view kShapes[] = {"SCALAR", "VEC2", "VEC3", "VEC4"};
    const auto found = std::find(std::begin(kShapes), std::end(kShapes), shape);
    const bool is_matrix = matrices_ && shape == "MAT4" && type_ == kFloat;
    if (!is_matrix && found == std::end(kShapes)) {
      return fail("expected type SCALAR, VEC2, VEC3 or VEC4, found '" + shape.substr(0, 20) + "'");
    }
    out.components = is_matrix ? 16 : found - std::begin(kShapes) + 1;
    return out.count > 0 || fail("expected a count above 0, found 0");
  }

  size_t size_of(const GltfValues& values) const {
    return component_bytes(type_) * values.components;
  }

  void put(const char* from, size_t element, GltfValues& out) const {
    for (size_t k = 0; k < out.components; ++k) {
      out.numbers[element * out.components + k] =
          component(from + k * component_bytes(type_), type_, normalized_);
    }
  }

  // Finds the `count` elements of `size` bytes that `part` (an accessor or a part of a sparse one)
  // locates in a view.
  bool find_elements(const GltfPart& part, int which, size_t count, size_t size, Elements& out) {
    const GltfPart view = root_.item("bufferViews", which);
    if (const char* name = gltf_packing(view)) {
      return checker_.fail(asked_at_, "expected plain motion, found it packed with " +
                                          std::string(name) +
                                          "; 'gltf-transform copy IN.glb OUT.glb' unpacks it");
    }
    const std::string_view bytes = container_.bytes_of(view);
    const uint64_t stride = view.count("byteStride", size), at = part.count("byteOffset");
    if (!checker_.ok()) return false;
    if (stride < size || at > bytes.size() || bytes.size() - at < size ||
        (count - 1) > (bytes.size() - at - size) / stride) {
      return fail("expected " + std::to_string(count) + " elements within the " +
                  std::to_string(bytes.size()) + " bytes of " + view.path() +
                  ", found it too short");
    }
    out = {bytes.data() + at, static_cast<size_t>(stride)};
    return true;
  }

  bool read_sparse(const GltfPart& sparse, GltfValues& out) {
    const uint64_t count = sparse.count("count");
    const GltfPart indices = sparse.object("indices"), values = sparse.object("values");
    if (!checker_.ok() || count == 0) return checker_.ok();
    if (count > out.count) {
      return fail("expected at most " + std::to_string(out.count) +
                  " sparse elements, as many as there are elements, found " +
                  std::to_string(count));
    }
    if (!indices || !values) {
      return fail("expected indices and values in sparse, one of the two is missing");
    }
    const uint64_t index_type = indices.count("componentType");
    if (!checker_.ok()) return false;
    if (index_type != kUint8 && index_type != kUint16 && index_type != kUint32) {
      return fail("expected sparse indices of type 5121, 5123 or 5125, found " +
                  std::to_string(index_type));
    }
    const size_t index_bytes = component_bytes(index_type);
    Elements at, from;
    if (!find_sparse(indices, count, index_bytes, at) ||
        !find_sparse(values, count, size_of(out), from)) {
      return false;
    }
    for (size_t i = 0; i < count; ++i) {
      const size_t element = little_endian({at.at(i), index_bytes});
      if (element >= out.count) {
        return fail("expected sparse indices below " + std::to_string(out.count) + ", found " +
                    std::to_string(element));
      }
      put(from.at(i), element, out);
    }
    return true;
  }

  bool find_sparse(const GltfPart& part, size_t count, size_t size, Elements& out) {
    const int view = part.index("bufferView", root_.size("bufferViews"));
    if (view < 0) return part.fail("expected a bufferView, found none");
    return find_elements(part, view, count, size, out);
  }

  bool check_numbers(const GltfValues& values) {
    for (size_t i = 0; i < values.numbers.size(); ++i) {
      if (std::abs(values.numbers[i]) <= kLargestNumber) continue;
      return fail("expected numbers between -1e9 and 1e9, found another in element " +
                  std::to_string(i / values.components));
    }
    return true;
  }

  const GltfContainer& container_;
  GltfPart root_, accessor_;
  const std::string& asked_at_;
  GltfChecker& checker_;
  bool matrices_;
  uint64_t type_ = 0;
  bool normalized_ = false;
};

}  // namespace

bool read_gltf_accessor(const GltfContainer& container, int which, const std::string& path,
                        GltfChecker& checker, GltfValues& out) {
  return AccessorReader(container, which, path, checker, false).read(out);
}

bool read_gltf_matrices(const GltfContainer& container, int which, const std::string& path,
                        GltfChecker& checker, GltfValues& out) {
  return AccessorReader(container, which, path, checker, true).read(out) &&
         (out.components == 16 || checker.fail(path, "expected matrices of floats (MAT4)"));
}

}  // namespace panache
