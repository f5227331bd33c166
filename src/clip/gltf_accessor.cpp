#include "clip/gltf_accessor.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <string_view>

#include "clip/decimal.h"

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

// Bytes of a component; 0 where there is no such type.
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

uint32_t little_endian(const char* bytes, size_t size) {
  uint32_t value = 0;
  for (size_t i = size; i-- > 0;) value = value << 8 | static_cast<unsigned char>(bytes[i]);
  return value;
}

float component(const char* bytes, uint64_t type, bool normalized) {
  const uint32_t bits = little_endian(bytes, component_bytes(type));
  double value = 0, largest = 1;
  switch (type) {
    case kInt8:
      value = static_cast<int8_t>(bits);
      largest = 127;
      break;
    case kUint8:
      value = bits;
      largest = 255;
      break;
    case kInt16:
      value = static_cast<int16_t>(bits);
      largest = 32767;
      break;
    case kUint16:
      value = bits;
      largest = 65535;
      break;
    case kUint32:
      value = bits;
      largest = 4294967295.0;
      break;
    default:
      return std::bit_cast<float>(bits);
  }
  // Both of the two lowest signed numbers stand for -1.
  return static_cast<float>(normalized ? std::max(value / largest, -1.0) : value);
}

class AccessorReader {
 public:
  AccessorReader(const GltfContainer& container, const std::string& asked_at, GltfChecker& checker,
                 bool matrices)
      : container_(container), asked_at_(asked_at), checker_(checker), matrices_(matrices) {}

  bool read(int which, GltfValues& out) {
    path_ = item_path("accessors", static_cast<size_t>(which));
    const GltfJson& accessor = container_.json["accessors"][which];
    if (!read_layout(accessor, out)) return false;
    const GltfJson *views = nullptr, *sparse = nullptr;
    int view = -1;
    if (!checker_.list(container_.json, "", "bufferViews", views)) return false;
    if (!checker_.index(accessor, path_, "bufferView", views->size(), view)) return false;
    if (!checker_.object(accessor, path_, "sparse", sparse)) return false;
    if (view >= 0) {
      if (!read_dense(accessor, view, out)) return false;
    } else {
      // Zeros, whose number nothing in the file bounds but its size.
      if (out.count > bytes_of_file()) {
        return fail("expected fewer zeros than the file has bytes, found " +
                    std::to_string(out.count));
      }
      out.numbers.assign(out.count * out.components, 0.0f);
    }
    if (sparse && !read_sparse(*sparse, out)) return false;
    return check_numbers(out);
  }

 private:
  // A message about this accessor, at the place where it is asked for.
  bool fail(const std::string& message) {
    return checker_.fail(asked_at_ + " (" + path_ + ")", message);
  }

  size_t bytes_of_file() const {
    size_t bytes = 0;
    for (const auto& buffer : container_.buffers) bytes += buffer ? buffer->size() : 0;
    return bytes;
  }

  bool read_layout(const GltfJson& accessor, GltfValues& out) {
    if (!checker_.is_object(accessor, path_)) return false;
    uint64_t count = 0;
    std::string shape;
    if (!checker_.count(accessor, path_, "count", count)) return false;
    if (!checker_.count(accessor, path_, "componentType", type_)) return false;
    if (!checker_.flag(accessor, path_, "normalized", normalized_)) return false;
    if (!checker_.text(accessor, path_, "type", shape)) return false;
    if (component_bytes(type_) == 0) {
      return fail("expected a componentType of 5120 to 5126, found " + std::to_string(type_));
    }
    if (matrices_ && shape == "MAT4" && type_ == kFloat) {
      out.components = 16;
      out.count = count;
      return count > 0 || fail("expected a count above 0, found 0");
    }
    constexpr std::string_view kShapes[] = {"SCALAR", "VEC2", "VEC3", "VEC4"};
    const auto found = std::find(std::begin(kShapes), std::end(kShapes), shape);
    if (found == std::end(kShapes)) {
      return fail("expected type SCALAR, VEC2, VEC3 or VEC4, found '" + shape.substr(0, 20) + "'");
    }
    out.components = static_cast<size_t>(found - std::begin(kShapes)) + 1;
    out.count = count;
    return count > 0 || fail("expected a count above 0, found 0");
  }

  // The bytes of `count` elements of `size` bytes that `object` (an accessor or a part of a sparse
  // one) places in `view`.
  bool find_elements(const GltfJson& object, const std::string& path, int view, size_t count,
                     size_t size, const char*& first, size_t& stride) {
    const std::string view_path = item_path("bufferViews", static_cast<size_t>(view));
    const GltfJson& json = container_.json["bufferViews"][view];
    if (!checker_.is_object(json, view_path)) return false;
    if (!check_compression(json, view_path)) return false;
    int buffer = -1;
    uint64_t view_at = 0, view_size = 0, at = 0, wide_stride = size;
    if (!checker_.index(json, view_path, "buffer", container_.buffers.size(), buffer) ||
        !checker_.count(json, view_path, "byteOffset", view_at) ||
        !checker_.count(json, view_path, "byteLength", view_size) ||
        !checker_.count(json, view_path, "byteStride", wide_stride) ||
        !checker_.count(object, path, "byteOffset", at)) {
      return false;
    }
    const std::string buffer_path = "buffers[" + std::to_string(buffer) + "]";
    if (buffer < 0 || !container_.buffers[buffer]) {
      return checker_.fail(view_path, "expected a buffer with data, found none");
    }
    const std::string& bytes = *container_.buffers[buffer];
    if (view_at > bytes.size() || view_size > bytes.size() - view_at) {
      return checker_.fail(view_path, "expected a part of the " + std::to_string(bytes.size()) +
                                          " bytes of " + buffer_path + ", found " +
                                          std::to_string(view_size) + " bytes from byte " +
                                          std::to_string(view_at) + " on");
    }
    if (wide_stride < size || at > view_size || view_size - at < size ||
        (count - 1) > (view_size - at - size) / wide_stride) {
      return fail("expected " + std::to_string(count) + " elements within the " +
                  std::to_string(view_size) + " bytes of " + view_path + ", found it too short");
    }
    first = bytes.data() + view_at + at;
    stride = static_cast<size_t>(wide_stride);  // Beyond the file only where there is one element.
    return true;
  }

  bool check_compression(const GltfJson& view, const std::string& path) {
    const GltfJson* extensions = nullptr;
    if (!checker_.object(view, path, "extensions", extensions)) return false;
    for (const char* name : {"EXT_meshopt_compression", "KHR_meshopt_compression"}) {
      if (extensions && extensions->contains(name)) {
        return checker_.fail(asked_at_, "expected plain motion, found it packed with " +
                                            std::string(name) +
                                            "; 'gltf-transform copy IN.glb OUT.glb' unpacks it");
      }
    }
    return true;
  }

  bool read_dense(const GltfJson& accessor, int view, GltfValues& out) {
    const size_t bytes = component_bytes(type_);
    const char* first = nullptr;
    size_t stride = 0;
    if (!find_elements(accessor, path_, view, out.count, bytes * out.components, first, stride)) {
      return false;
    }
    // A stride is at least a component here, and the elements lie within the buffer; that bounds
    // the room taken.
    out.numbers.resize(out.count * out.components);
    for (size_t i = 0; i < out.count; ++i) {
      for (size_t k = 0; k < out.components; ++k) {
        out.numbers[i * out.components + k] =
            component(first + i * stride + k * bytes, type_, normalized_);
      }
    }
    return true;
  }

  bool read_sparse(const GltfJson& sparse, GltfValues& out) {
    const std::string path = member_path(path_, "sparse");
    const GltfJson *indices = nullptr, *values = nullptr;
    uint64_t count = 0, index_type = 0;
    if (!checker_.count(sparse, path, "count", count) ||
        !checker_.object(sparse, path, "indices", indices) ||
        !checker_.object(sparse, path, "values", values)) {
      return false;
    }
    if (count == 0) return true;
    if (count > out.count) {
      return fail("expected at most " + std::to_string(out.count) +
                  " sparse elements, as many as there are elements, found " +
                  std::to_string(count));
    }
    if (!indices || !values)
      return fail("expected indices and values in sparse, one of the two is missing");
    if (!checker_.count(*indices, member_path(path, "indices"), "componentType", index_type)) {
      return false;
    }
    if (index_type != kUint8 && index_type != kUint16 && index_type != kUint32) {
      return fail("expected sparse indices of type 5121, 5123 or 5125, found " +
                  std::to_string(index_type));
    }
    const size_t bytes = component_bytes(type_), index_bytes = component_bytes(index_type);
    const char *first_index = nullptr, *first_value = nullptr;
    size_t index_stride = 0, value_stride = 0;
    if (!find_sparse(*indices, member_path(path, "indices"), count, index_bytes, first_index,
                     index_stride) ||
        !find_sparse(*values, member_path(path, "values"), count, bytes * out.components,
                     first_value, value_stride)) {
      return false;
    }
    for (size_t i = 0; i < count; ++i) {
      const size_t element = little_endian(first_index + i * index_stride, index_bytes);
      if (element >= out.count) {
        return fail("expected sparse indices below " + std::to_string(out.count) + ", found " +
                    std::to_string(element));
      }
      for (size_t k = 0; k < out.components; ++k) {
        out.numbers[element * out.components + k] =
            component(first_value + i * value_stride + k * bytes, type_, normalized_);
      }
    }
    return true;
  }

  bool find_sparse(const GltfJson& part, const std::string& path, size_t count, size_t size,
                   const char*& first, size_t& stride) {
    int view = -1;
    const GltfJson* views = nullptr;
    if (!checker_.list(container_.json, "", "bufferViews", views)) return false;
    if (!checker_.index(part, path, "bufferView", views->size(), view)) return false;
    if (view < 0) return checker_.fail(path, "expected a bufferView, found none");
    return find_elements(part, path, view, count, size, first, stride);
  }

  bool check_numbers(const GltfValues& values) {
    for (size_t i = 0; i < values.numbers.size(); ++i) {
      if (!(std::abs(static_cast<double>(values.numbers[i])) <= kLargestNumber)) {
        return fail("expected numbers between -1e9 and 1e9, found another in element " +
                    std::to_string(i / values.components));
      }
    }
    return true;
  }

  const GltfContainer& container_;
  const std::string& asked_at_;
  GltfChecker& checker_;
  bool matrices_;
  std::string path_;
  uint64_t type_ = 0;
  bool normalized_ = false;
};

}  // namespace

bool read_gltf_accessor(const GltfContainer& container, int which, const std::string& path,
                        GltfChecker& checker, GltfValues& out) {
  return AccessorReader(container, path, checker, false).read(which, out);
}

bool read_gltf_matrices(const GltfContainer& container, int which, const std::string& path,
                        GltfChecker& checker, GltfValues& out) {
  return AccessorReader(container, path, checker, true).read(which, out) &&
         (out.components == 16 || checker.fail(path, "expected matrices of floats (MAT4)"));
}

}  // namespace panache
