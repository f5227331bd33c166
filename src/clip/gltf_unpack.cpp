#include "clip/gltf_container.h"

#include <algorithm>
#include <initializer_list>
#include <string_view>

#include "clip/gltf.h"
#include "clip/gltf_json.h"

namespace panache {
namespace {

MeshoptDecoder decoder = nullptr;

// They differ in what the second adds, which the decoder may reject.
constexpr const char* kNames[] = {"EXT_meshopt_compression", "KHR_meshopt_compression"};
// For all data together; parts of a small file may refer to the same bytes many times.
constexpr size_t kMaxBytes = size_t{1} << 30;
// Maximum ratio of unpacked to packed size: more than either version of the packing reaches.
constexpr size_t kMaxRatio = 1024;

bool is_packed_accessor(const GltfPart& root, int which) {
  if (which < 0) return false;
  const GltfPart accessor = root.item("accessors", which), sparse = accessor.object("sparse");
  for (const GltfPart& part : {accessor, sparse.object("indices"), sparse.object("values")}) {
    const int view = part.index("bufferView", root.size("bufferViews"));
    if (view >= 0 && gltf_packing(root.item("bufferViews", view))) return true;
  }
  return false;
}

class Unpacker {
 public:
  Unpacker(const GltfContainer& in, GltfChecker& checker, GltfContainer& out)
      : in_(in), checker_(checker), out_(out) {}

  bool unpack() {
    out_ = in_;
    const std::vector<GltfPart> views = GltfPart(in_.json, checker_).list("bufferViews");
    for (size_t i = 0; i < views.size(); ++i) {
      if (!add_view(views[i], out_.json["bufferViews"][i])) return false;
    }
    if (!checker_.ok()) return false;
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
  bool add_view(const GltfPart& view, GltfJson& out) {
    const char* name = gltf_packing(view);
    const GltfPart from = name ? view.object("extensions").object(name) : view;
    const std::string_view bytes = in_.bytes_of(from);
    if (!checker_.ok()) return false;
    const size_t begin = (bytes_.size() + 3) / 4 * 4;
    if (!name) {
      if (!has_room(view, begin, bytes.size())) return false;
      bytes_.resize(begin);
      bytes_ += bytes;
    } else {
      if (!decode(from, bytes, begin)) return false;
      out["extensions"].erase(name);
      if (out["extensions"].empty()) out.erase("extensions");
    }
    out["buffer"] = size_t{0};
    out["byteOffset"] = begin;
    out["byteLength"] = bytes_.size() - begin;
    return true;
  }

  static bool has_room(const GltfPart& part, size_t begin, size_t size) {
    return size <= kMaxBytes - std::min(begin, kMaxBytes) ||
           part.fail("expected at most 1 GB of data in all, found more");
  }

  bool decode(const GltfPart& from, std::string_view packed, size_t begin) {
    MeshoptView view;
    if (!read_view(from, view)) return false;
    if (view.count > packed.size() * kMaxRatio / view.stride) {
      return from.fail("expected at most " + std::to_string(kMaxRatio) +
                       " times the bytes that are packed, found a count of " +
                       std::to_string(view.count));
    }
    if (!has_room(from, begin, view.count * view.stride)) return false;
    bytes_.resize(begin + view.count * view.stride);
    return decoder(view, packed, bytes_.data() + begin) ||
           from.fail(
               "expected data in the first version of meshoptimizer's packing, found other data; "
               "'gltf-transform copy IN.glb OUT.glb' unpacks newer versions");
  }

  static bool read_view(const GltfPart& from, MeshoptView& out) {
    out.count = from.count("count");
    out.stride = from.count("byteStride");
    const int mode = word(from, "mode", {"ATTRIBUTES", "TRIANGLES", "INDICES"});
    const int filter = word(from, "filter", {"NONE", "OCTAHEDRAL", "QUATERNION", "EXPONENTIAL"});
    if (!from.ok()) return false;
    if (mode < 0) return from.fail("expected a mode, found none");
    out.mode = static_cast<MeshoptMode>(mode);
    out.filter = static_cast<MeshoptFilter>(std::max(filter, 0));
    const size_t stride = out.stride;
    const bool is_attribute = out.mode == MeshoptMode::attributes;
    const bool fits =
        is_attribute ? stride >= 4 && stride <= 256 && stride % 4 == 0 : stride == 2 || stride == 4;
    using enum MeshoptFilter;
    const bool fits_filter =
        out.filter == none || (is_attribute && (out.filter == exponential || stride == 8 ||
                                                (out.filter == octahedral && stride == 4)));
    if (!fits || !fits_filter) {
      return from.fail("expected a byteStride for its mode and filter, found " +
                       std::to_string(stride));
    }
    const bool whole = out.mode != MeshoptMode::triangles || out.count % 3 == 0;
    return (out.count > 0 && whole) ||
           from.fail("expected a count above 0, of whole triangles where it holds them, found " +
                     std::to_string(out.count));
  }

  // The index of a member among `words`; -1 if it is absent.
  static int word(const GltfPart& from, const char* key,
                  std::initializer_list<std::string_view> words) {
    const std::string found = from.text(key);
    const auto at = std::find(words.begin(), words.end(), found);
    if (found.empty()) return -1;
    if (at != words.end()) return static_cast<int>(at - words.begin());
    from.member(key).fail("expected a word of the extension, found '" + found.substr(0, 20) + "'");
    return -1;
  }

  // Removes the extensions from a list of those that the file uses.
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
  std::string bytes_;  // Of the single buffer.
};

}  // namespace

void set_meshopt_decoder(MeshoptDecoder with) { decoder = with; }

const char* gltf_packing(const GltfPart& view) {
  const GltfPart extensions = view.object("extensions");
  for (const char* name : kNames) {
    if (extensions && extensions.json().contains(name)) return name;
  }
  return nullptr;
}

bool has_packed_data(const GltfContainer& container) {
  GltfChecker unheard("");
  return decoder && std::ranges::any_of(GltfPart(container.json, unheard).list("bufferViews"),
                                        [](const GltfPart& view) { return gltf_packing(view); });
}

bool has_packed_motion(const GltfContainer& container) {
  GltfChecker unheard("");
  const GltfPart root(container.json, unheard);
  const size_t accessors = root.size("accessors");
  for (const GltfPart& animation : root.list("animations")) {
    for (const GltfPart& sampler : animation.list("samplers")) {
      if (is_packed_accessor(root, sampler.index("input", accessors)) ||
          is_packed_accessor(root, sampler.index("output", accessors))) {
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
