#include "clip/gltf_unpack.h"

#include <algorithm>
#include <initializer_list>
#include <string_view>

#include "clip/gltf_uri.h"
#include "clip/meshopt.h"

namespace panache {
namespace {

MeshoptDecoder decoder = nullptr;

// They differ in what the second adds, which the decoder may reject.
constexpr const char* kNames[] = {"EXT_meshopt_compression", "KHR_meshopt_compression"};
// Of all data in all; parts of a small file may be the same bytes again and again.
constexpr size_t kMaxBytes = size_t{1} << 30;
// How many times smaller than its data a part may be: more than either version of the packing does.
constexpr size_t kMaxRatio = 1024;

// The member `key`, or null where there is none.
const GltfJson* member(const GltfJson* object, const char* key) {
  if (!object || !object->is_object()) return nullptr;
  const auto found = object->find(key);
  return found == object->end() ? nullptr : &*found;
}
// What the member `key` is the place of in the file's list `of`, or null.
const GltfJson* item(const GltfJson& json, const char* of, const GltfJson* object,
                     const char* key) {
  const GltfJson *list = member(&json, of), *place = member(object, key);
  if (!list || !list->is_array() || !place || !place->is_number_unsigned()) return nullptr;
  const auto index = place->get<uint64_t>();
  return index < list->size() ? &(*list)[index] : nullptr;
}

// The extension that packs a view, or null.
const char* packing(const GltfJson* view) {
  const GltfJson* extensions = member(view, "extensions");
  for (const char* name : kNames) {
    if (member(extensions, name)) return name;
  }
  return nullptr;
}

bool is_packed_accessor(const GltfJson& json, const GltfJson* accessor) {
  const GltfJson* sparse = member(accessor, "sparse");
  return packing(item(json, "bufferViews", accessor, "bufferView")) ||
         packing(item(json, "bufferViews", member(sparse, "indices"), "bufferView")) ||
         packing(item(json, "bufferViews", member(sparse, "values"), "bufferView"));
}

class Unpacker {
 public:
  Unpacker(const GltfContainer& in, GltfChecker& checker, GltfContainer& out)
      : in_(in), checker_(checker), out_(out) {}

  bool unpack() {
    const GltfJson* views = nullptr;
    if (!checker_.list(in_.json, "", "bufferViews", views)) return false;
    out_ = in_;
    for (size_t i = 0; i < views->size(); ++i) {
      if (!add_view((*views)[i], item_path("bufferViews", i), out_.json["bufferViews"][i])) {
        return false;
      }
    }
    for (const char* list : {"extensionsUsed", "extensionsRequired"}) forget(list);
    GltfJson buffer = {{"byteLength", bytes_.size()}};
    if (!in_.binary) buffer["uri"] = make_data_uri("application/octet-stream", bytes_);
    out_.json["buffers"] = GltfJson::array({buffer});
    out_.has_bin = in_.binary;
    out_.size += bytes_.size();
    out_.buffers.clear();
    out_.buffers.emplace_back(std::move(bytes_));
    return true;
  }

 private:
  bool add_view(const GltfJson& view, const std::string& path, GltfJson& out) {
    if (!checker_.is_object(view, path)) return false;
    const char* name = packing(&view);
    const std::string from_path =
        name ? member_path(path, "extensions." + std::string(name)) : path;
    const GltfJson& from = name ? view["extensions"][name] : view;
    std::string_view bytes;
    if (!checker_.is_object(from, from_path) || !find_bytes(from, from_path, bytes)) return false;
    const size_t begin = (bytes_.size() + 3) / 4 * 4;
    if (!name) {
      if (!has_room(path, begin, bytes.size())) return false;
      bytes_.resize(begin);
      bytes_ += bytes;
    } else {
      if (!decode(from, from_path, bytes, begin)) return false;
      out["extensions"].erase(name);
      if (out["extensions"].empty()) out.erase("extensions");
    }
    out["buffer"] = size_t{0};
    out["byteOffset"] = begin;
    out["byteLength"] = bytes_.size() - begin;
    return true;
  }

  bool has_room(const std::string& path, size_t begin, size_t size) {
    return size <= kMaxBytes - std::min(begin, kMaxBytes) ||
           checker_.fail(path, "expected at most 1 GB of data in all, found more");
  }

  bool find_bytes(const GltfJson& from, const std::string& path, std::string_view& out) {
    int buffer = -1;
    uint64_t at = 0, size = 0;
    if (!checker_.index(from, path, "buffer", in_.buffers.size(), buffer) ||
        !checker_.count(from, path, "byteOffset", at) ||
        !checker_.count(from, path, "byteLength", size)) {
      return false;
    }
    if (buffer < 0 || !in_.buffers[buffer]) {
      return checker_.fail(path, "expected a buffer with data, found none");
    }
    const std::string& bytes = *in_.buffers[buffer];
    if (at > bytes.size() || size > bytes.size() - at) {
      return checker_.fail(path, "expected a part of the " + std::to_string(bytes.size()) +
                                     " bytes of buffers[" + std::to_string(buffer) + "], found " +
                                     std::to_string(size) + " bytes from byte " +
                                     std::to_string(at) + " on");
    }
    out = std::string_view(bytes).substr(at, size);
    return true;
  }

  bool decode(const GltfJson& from, const std::string& path, std::string_view packed,
              size_t begin) {
    MeshoptView view;
    if (!read_view(from, path, view)) return false;
    if (view.count > packed.size() * kMaxRatio / view.stride) {
      return checker_.fail(path, "expected at most " + std::to_string(kMaxRatio) +
                                     " times the bytes that are packed, found a count of " +
                                     std::to_string(view.count));
    }
    if (!has_room(path, begin, view.count * view.stride)) return false;
    bytes_.resize(begin + view.count * view.stride);
    return decoder(view, packed, bytes_.data() + begin) ||
           checker_.fail(path,
                         "expected data in the first version of meshoptimizer's packing, found "
                         "other data; 'gltf-transform copy IN.glb OUT.glb' unpacks newer versions");
  }

  bool read_view(const GltfJson& from, const std::string& path, MeshoptView& out) {
    uint64_t count = 0, stride = 0;
    int mode = -1, filter = 0;
    if (!checker_.count(from, path, "count", count) ||
        !checker_.count(from, path, "byteStride", stride) ||
        !word(from, path, "mode", {"ATTRIBUTES", "TRIANGLES", "INDICES"}, mode) ||
        !word(from, path, "filter", {"NONE", "OCTAHEDRAL", "QUATERNION", "EXPONENTIAL"}, filter)) {
      return false;
    }
    if (mode < 0) return checker_.fail(path, "expected a mode, found none");
    out = {static_cast<MeshoptMode>(mode), static_cast<MeshoptFilter>(filter),
           static_cast<size_t>(count), static_cast<size_t>(stride)};
    const bool is_attribute = out.mode == MeshoptMode::attributes;
    const bool fits =
        is_attribute ? stride >= 4 && stride <= 256 && stride % 4 == 0 : stride == 2 || stride == 4;
    if (!fits || !fits_filter(out)) {
      return checker_.fail(
          path, "expected a byteStride for its mode and filter, found " + std::to_string(stride));
    }
    const bool whole = out.mode != MeshoptMode::triangles || count % 3 == 0;
    return (count > 0 && whole) ||
           checker_.fail(path,
                         "expected a count above 0, of whole triangles where it holds them, "
                         "found " +
                             std::to_string(count));
  }

  static bool fits_filter(const MeshoptView& view) {
    switch (view.filter) {
      case MeshoptFilter::octahedral:
        return view.mode == MeshoptMode::attributes && (view.stride == 4 || view.stride == 8);
      case MeshoptFilter::quaternion:
        return view.mode == MeshoptMode::attributes && view.stride == 8;
      case MeshoptFilter::exponential:
        return view.mode == MeshoptMode::attributes;
      default:
        return true;
    }
  }

  // The place of the member `key` among `words`; `out` stays where it is absent.
  bool word(const GltfJson& from, const std::string& path, const char* key,
            std::initializer_list<std::string_view> words, int& out) {
    std::string found;
    if (!checker_.text(from, path, key, found)) return false;
    if (found.empty()) return true;
    const auto at = std::find(words.begin(), words.end(), found);
    out = static_cast<int>(at - words.begin());
    return at != words.end() ||
           checker_.fail(member_path(path, key),
                         "expected a word of the extension, found '" + found.substr(0, 20) + "'");
  }

  // Takes the extensions from a list of those that the file uses.
  void forget(const char* list) {
    GltfJson* names = out_.json.contains(list) ? &out_.json[list] : nullptr;
    if (!names || !names->is_array()) return;
    GltfJson left = GltfJson::array();
    for (const GltfJson& name : *names) {
      if (name != kNames[0] && name != kNames[1]) left.push_back(name);
    }
    *names = left;
    if (left.empty()) out_.json.erase(list);
  }

  const GltfContainer& in_;
  GltfChecker& checker_;
  GltfContainer& out_;
  std::string bytes_;  // Of the one buffer.
};

}  // namespace

void set_meshopt_decoder(MeshoptDecoder with) { decoder = with; }

bool has_packed_data(const GltfContainer& container) {
  const GltfJson* views = member(&container.json, "bufferViews");
  return decoder && views && views->is_array() &&
         std::any_of(views->begin(), views->end(),
                     [](const GltfJson& view) { return packing(&view) != nullptr; });
}

bool has_packed_motion(const GltfContainer& container) {
  const GltfJson& json = container.json;
  const GltfJson* animations = member(&json, "animations");
  if (!animations || !animations->is_array()) return false;
  for (const GltfJson& animation : *animations) {
    const GltfJson* samplers = member(&animation, "samplers");
    if (!samplers || !samplers->is_array()) continue;
    for (const GltfJson& sampler : *samplers) {
      if (is_packed_accessor(json, item(json, "accessors", &sampler, "input")) ||
          is_packed_accessor(json, item(json, "accessors", &sampler, "output"))) {
        return true;
      }
    }
  }
  return false;
}

bool unpack_gltf(const GltfContainer& container, GltfChecker& checker, GltfContainer& out) {
  return Unpacker(container, checker, out).unpack();
}

}  // namespace panache
