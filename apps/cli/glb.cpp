#include "glb.h"

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <string_view>
#include <system_error>
#include <vector>

#include "base/file.h"
#include "base/bytes.h"
#include "base/text.h"
#include "clip/gltf_json.h"
#include "clip/text_cursor.h"

namespace panache::cli {
namespace {

namespace fs = std::filesystem;

// A header of 12 bytes (magic, version, total length), then chunks: length, type, bytes. The first
// chunk is the JSON, the optional second one the binary data.
constexpr size_t kHeader = 12, kChunkHeader = 8;

void append_chunk(std::string& out, const std::string& type, std::string bytes, char padding) {
  bytes.resize((bytes.size() + 3) / 4 * 4, padding);
  append_little_endian(bytes.size(), 4, out);
  out += type + bytes;
}

std::string format_glb_file(const GltfJson& json, const std::string& bin) {
  std::string chunks;
  append_chunk(chunks, "JSON", json.dump(-1, ' ', false, GltfJson::error_handler_t::replace), ' ');
  if (!bin.empty()) append_chunk(chunks, std::string("BIN\0", 4), bin, '\0');
  std::string out = "glTF";
  append_little_endian(2, 4, out);
  append_little_endian(kHeader + chunks.size(), 4, out);
  return out += chunks;
}

// Finds a picture at its path below `folder`, or at the end of that path: for "C:/art/tex/skin.png"
// also "tex/skin.png" and "skin.png".
std::string find_picture(std::string uri, const fs::path& folder) {
  for (char& c : uri) {
    if (c == '\\') c = '/';
  }
  std::error_code status;
  for (size_t at = 0; at < uri.size();) {
    const fs::path tail = uri.substr(at);
    if (tail.is_relative() && fs::is_regular_file(folder / tail, status)) return tail.string();
    const size_t next = uri.find('/', at);
    at = next == std::string::npos ? uri.size() : next + 1;
  }
  return "";
}

// An extension that is no longer supported; the metallic-roughness material has the same content.
void drop_specular_glossiness(GltfJson& json) {
  constexpr const char* kName = "KHR_materials_pbrSpecularGlossiness";
  if (!json.contains("extensionsUsed") || !json.contains("materials")) return;
  for (GltfJson& material : json["materials"]) {
    if (!material.contains("extensions") || !material["extensions"].is_object()) continue;
    material["extensions"].erase(kName);
    if (material["extensions"].empty()) material.erase("extensions");
  }
  GltfJson used = GltfJson::array();
  for (const GltfJson& name : json["extensionsUsed"]) {
    if (name != kName) used.push_back(name);
  }
  json["extensionsUsed"] = used;
  if (used.empty()) json.erase("extensionsUsed");
}

// A list in the file; empty if it is not a list.
GltfJson& list_of(GltfJson& json, const char* key) {
  static thread_local GltfJson none;
  const auto list = json.find(key);
  if (list != json.end() && list->is_array()) return *list;
  return none = GltfJson::array();
}

// The member `key` as an index into a list of `size` entries; -1 if it is not a valid index.
int index_in(const GltfJson& object, const char* key, size_t size) {
  if (!object.is_object()) return -1;
  const auto member = object.find(key);
  if (member == object.end() || !member->is_number_unsigned()) return -1;
  const auto index = member->get<uint64_t>();
  return index < size ? static_cast<int>(index) : -1;
}

// The types that glTF supports, "image/png" or "image/jpeg"; else empty.
std::string kind_of(std::string_view picture) {
  if (picture.starts_with("\x89PNG")) return "image/png";
  return picture.starts_with("\xFF\xD8\xFF") ? "image/jpeg" : "";
}

// Repairs the pictures of materials.
class PictureRepair {
 public:
  PictureRepair(GltfJson& json, std::string& bin, const std::string& path,
                const PictureToPng& to_png, std::vector<std::string>& notes)
      : json_(json), bin_(bin), path_(path), to_png_(to_png), notes_(notes) {}

  void run() {
    GltfJson& images = list_of(json_, "images");
    std::vector<int> image_indices, texture_indices;  // New indices; -1 if removed.
    std::vector<GltfJson> kept;
    for (size_t i = 0; i < images.size(); ++i) {
      const bool good = repair(i);
      image_indices.push_back(good ? static_cast<int>(kept.size()) : -1);
      if (good) kept.push_back(json_["images"][i]);
    }
    const size_t count = images.size();
    GltfJson textures = GltfJson::array();
    for (GltfJson& texture : list_of(json_, "textures")) {
      const int image = index_in(texture, "source", count);
      const int new_image = image < 0 ? -1 : image_indices[static_cast<size_t>(image)];
      texture_indices.push_back(image >= 0 && new_image < 0 ? -1
                                                            : static_cast<int>(textures.size()));
      if (texture_indices.back() < 0) continue;
      if (image >= 0) texture["source"] = new_image;
      textures.push_back(std::move(texture));
    }
    for (GltfJson& material : list_of(json_, "materials")) {
      // A texture replaces the colour in FBX, but is multiplied by it in glTF.
      whiten(material, "pbrMetallicRoughness", "baseColorTexture", "baseColorFactor");
      whiten(material, "", "emissiveTexture", "emissiveFactor");
      renumber(material, texture_indices);
    }
    set_or_drop("images", kept);
    set_or_drop("textures", std::move(textures));
  }

 private:
  void set_or_drop(const char* key, GltfJson list) {
    if (!json_.contains(key)) return;
    if (list.empty()) {
      json_.erase(key);
    } else {
      json_[key] = std::move(list);
    }
  }

  // Makes the colour of a textured material white; keeps its opacity.
  static void whiten(GltfJson& material, const char* part, const char* texture,
                     const char* factor) {
    if (!material.is_object() || (*part && !material.contains(part))) return;
    GltfJson& object = *part ? material[part] : material;
    if (!object.is_object() || !object.contains(texture)) return;
    if (!*part) {
      object[factor] = {1.0, 1.0, 1.0};
    } else if (object.contains(factor) && object[factor].is_array() && object[factor].size() == 4) {
      for (size_t i = 0; i < 3; ++i) object[factor][i] = 1.0;
    }
  }

  // Removes missing textures and renumbers the others, in extensions too.
  static void renumber(GltfJson& object, const std::vector<int>& new_indices) {
    if (!object.is_object()) return;
    std::vector<std::string> gone;
    for (auto& [key, value] : object.items()) {
      const int index =
          key.ends_with("Texture") ? index_in(value, "index", new_indices.size()) : -1;
      if (index < 0) {
        renumber(value, new_indices);
        continue;
      }
      value["index"] = new_indices[static_cast<size_t>(index)];
      if (new_indices[static_cast<size_t>(index)] < 0) gone.push_back(key);
    }
    for (const std::string& key : gone) object.erase(key);
  }

  // Whether programs can show the picture after the repair.
  bool repair(size_t which) {
    GltfJson& image = json_["images"][which];
    if (!image.is_object()) return true;  // The reader reports the error.
    const GltfJson& views = list_of(json_, "bufferViews");
    const int view = index_in(image, "bufferView", views.size());
    if (view >= 0) {
      const std::string name = image.contains("name") && image["name"].is_string()
                                   ? image["name"].get<std::string>()
                                   : "texture " + std::to_string(which);
      return embed(image, bytes_of(views[static_cast<size_t>(view)]), name);
    }
    if (!image.contains("uri") || !image["uri"].is_string()) return true;
    const std::string uri = image["uri"];
    if (uri.starts_with("data:")) {
      const Result<std::string> bytes = decode_data_uri(uri);
      return !bytes || embed(image, *bytes, "texture " + std::to_string(which));
    }
    const fs::path folder = fs::path(path_).parent_path();
    const std::string found = find_picture(uri, folder);
    if (found.empty()) {
      return leave_out(panache::quoted(uri) + " is neither there nor beside the file");
    }
    Result<std::string> bytes = read_file((folder / found).string());
    if (!bytes) return leave_out(bytes.error().message);
    if (!kind_of(*bytes).empty()) {
      image["uri"] = percent_encoded(found, "-._~/");
      image["mimeType"] = kind_of(*bytes);
      return true;
    }
    image.erase("uri");
    return embed(image, *bytes, found);
  }

  std::string bytes_of(const GltfJson& view) const {
    if (!view.is_object()) return "";
    const auto number = [&](const char* key) -> uint64_t {
      const auto member = view.find(key);
      return member != view.end() && member->is_number_unsigned() ? member->get<uint64_t>() : 0;
    };
    const uint64_t begin = number("byteOffset"), size = number("byteLength");
    return begin > bin_.size() || size > bin_.size() - begin ? "" : bin_.substr(begin, size);
  }

  // Gives the image these bytes, converted to PNG if needed.
  bool embed(GltfJson& image, const std::string& bytes, const std::string& name) {
    if (const std::string kind = kind_of(bytes); !kind.empty()) {
      image["mimeType"] = kind;
      return true;
    }
    const Result<std::string> png = to_png_(bytes);
    if (!png) return leave_out(panache::quoted(name) + ": " + png.error().message);
    bin_.resize((bin_.size() + 3) / 4 * 4);
    GltfJson view = {{"buffer", 0}, {"byteOffset", bin_.size()}, {"byteLength", png->size()}};
    bin_ += *png;
    image.erase("uri");
    image["mimeType"] = "image/png";
    if (!json_.contains("bufferViews")) json_["bufferViews"] = GltfJson::array();
    image["bufferView"] = json_["bufferViews"].size();
    json_["bufferViews"].push_back(std::move(view));
    if (list_of(json_, "buffers").empty()) json_["buffers"] = {{{"byteLength", 0}}};
    json_["buffers"][0]["byteLength"] = bin_.size();
    return true;
  }

  bool leave_out(const std::string& what) {
    notes_.push_back(path_ + ": texture " + what + "; the material is written without it");
    return false;
  }

  GltfJson& json_;
  std::string& bin_;
  const std::string& path_;
  const PictureToPng& to_png_;
  std::vector<std::string>& notes_;
};

}  // namespace

std::string percent_encoded(const std::string& text, std::string_view plain) {
  std::string out;
  for (const char c : text) {
    const bool is_plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                          (c >= '0' && c <= '9') || plain.find(c) != plain.npos;
    char code[4];
    std::snprintf(code, sizeof code, "%%%02X", static_cast<unsigned char>(c));
    out += is_plain ? std::string(1, c) : code;
  }
  return out;
}

std::string with_pictures(std::string glb, const std::string& path, const PictureToPng& to_png,
                          std::vector<std::string>& notes) {
  if (glb.size() < kHeader + kChunkHeader) return glb;
  const size_t begin = kHeader + kChunkHeader;
  const size_t length = little_endian(std::string_view(glb).substr(kHeader, 4));
  if (length > glb.size() - begin) return glb;
  GltfJson json;  // The reader reports errors.
  // Assimp writes names that may not be valid UTF-8.
  if (!GltfChecker(path).parse(to_utf8({glb.data() + begin, length}), json)) return glb;
  drop_specular_glossiness(json);
  const size_t bin_at = begin + length + kChunkHeader;
  std::string bin = bin_at < glb.size() ? glb.substr(bin_at) : "";
  PictureRepair(json, bin, path, to_png, notes).run();
  return format_glb_file(json, bin);
}

Result<std::string> gltf_to_glb(const std::string& gltf, const std::string& path) {
  GltfChecker checker(path);
  GltfJson json;
  if (!checker.parse(gltf, json)) return checker.error();
  const GltfPart root(json, checker);
  const std::vector<GltfPart> buffers = root.list("buffers"), views = root.list("bufferViews");
  if (!checker.ok()) return checker.error();
  if (buffers.empty()) return format_glb_file(json, "");
  std::string bin;
  std::vector<size_t> begins;  // Offset of each buffer in `bin`.
  for (const GltfPart& buffer : buffers) {
    const std::string uri = buffer.text("uri");
    if (!buffer.member("uri")) {
      buffer.fail("holds no data of its own; expected a file that needs no extension for it");
    }
    if (!checker.ok()) return checker.error();
    Result<std::string> bytes = decode_data_uri(uri);
    if (!bytes) return located(path, bytes.error());
    bin.resize((bin.size() + 3) / 4 * 4);
    begins.push_back(bin.size());
    bin += *bytes;
  }
  for (size_t v = 0; v < views.size(); ++v) {
    const int buffer = views[v].index("buffer", begins.size());
    const uint64_t offset = views[v].count("byteOffset");
    if (buffer < 0) views[v].fail("expected a buffer, found none");
    if (!checker.ok()) return checker.error();
    GltfJson& view = json["bufferViews"][v];
    if (begins[buffer] > 0) view["byteOffset"] = begins[buffer] + offset;
    view["buffer"] = 0;
  }
  json["buffers"] = {{{"byteLength", bin.size()}}};
  return format_glb_file(json, bin);
}

}  // namespace panache::cli
