#include "glb.h"

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <system_error>
#include <vector>

#include "base/utf8.h"
#include "clip/gltf_json.h"
#include "clip/gltf_uri.h"

namespace panache::cli {
namespace {

namespace fs = std::filesystem;

// A PNG of one white pixel.
constexpr const char* kWhite =
    "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAAAAAA6fptVAAAACklEQVR42mP4DwABAQEAHLCM"
    "mQAAAABJRU5ErkJggg==";

// The header of 12 bytes (magic, version, length of all), then chunks: length, type, bytes. The
// first holds the JSON, the second, which may be absent, the binary data.
constexpr size_t kHeader = 12, kChunkHeader = 8;

uint32_t number_at(const std::string& glb, size_t place) {
  uint32_t value = 0;
  std::memcpy(&value, glb.data() + place, sizeof value);  // GLB and this machine: little-endian.
  return value;
}

void append_number(std::string& out, size_t value) {
  const auto small = static_cast<uint32_t>(value);
  out.append(reinterpret_cast<const char*>(&small), sizeof small);
}

void append_chunk(std::string& out, const std::string& type, std::string bytes, char padding) {
  bytes.resize((bytes.size() + 3) / 4 * 4, padding);
  append_number(out, bytes.size());
  out += type + bytes;
}

std::string format_glb_file(const GltfJson& json, const std::string& bin) {
  std::string chunks;
  append_chunk(chunks, "JSON", json.dump(-1, ' ', false, GltfJson::error_handler_t::replace), ' ');
  if (!bin.empty()) append_chunk(chunks, std::string("BIN\0", 4), bin, '\0');
  std::string out = "glTF";
  append_number(out, 2);
  append_number(out, kHeader + chunks.size());
  return out += chunks;
}

std::string find_picture(std::string uri, const fs::path& folder) {
  for (char& c : uri) {
    if (c == '\\') c = '/';
  }
  std::error_code status;
  for (const fs::path& place : {fs::path(uri), fs::path(uri).filename()}) {
    if (place.is_relative() && fs::is_regular_file(folder / place, status)) return place.string();
  }
  return "";
}

// As an address, which has its own way to write all but plain letters.
std::string percent_encoded(const std::string& path) {
  static constexpr char kDigits[] = "0123456789ABCDEF";
  std::string out;
  for (const char c : path) {
    const auto byte = static_cast<unsigned char>(c);
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                       std::strchr("-._~/", c);
    if (plain) {
      out += c;
    } else {
      out += {'%', kDigits[byte >> 4], kDigits[byte & 15]};
    }
  }
  return out;
}

// An extension that is no longer supported. The metallic-roughness material says the same.
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

}  // namespace

std::string with_pictures(std::string glb, const std::string& path) {
  if (glb.size() < kHeader + kChunkHeader) return glb;
  const size_t begin = kHeader + kChunkHeader, length = number_at(glb, kHeader);
  if (length > glb.size() - begin) return glb;
  GltfJson json;  // What is wrong with it, its reader says.
  // Assimp writes names of any bytes.
  if (!GltfChecker(path).parse(to_utf8({glb.data() + begin, length}), json)) return glb;
  drop_specular_glossiness(json);
  GltfJson no_images = GltfJson::array();
  for (GltfJson& image : json.contains("images") ? json["images"] : no_images) {
    if (!image.contains("uri") || !image["uri"].is_string()) continue;
    const std::string uri = image["uri"];
    if (uri.starts_with("data:")) continue;
    const std::string found = find_picture(uri, fs::path(path).parent_path());
    image["uri"] = found.empty() ? kWhite : percent_encoded(found);
  }
  const size_t bin = begin + length + kChunkHeader;
  return format_glb_file(json, bin < glb.size() ? glb.substr(bin) : "");
}

Result<std::string> gltf_to_glb(const std::string& gltf, const std::string& path) {
  GltfChecker checker(path);
  GltfJson json;
  const GltfJson *buffers = nullptr, *views = nullptr;
  const bool good = checker.parse(gltf, json) && checker.list(json, "", "buffers", buffers) &&
                    checker.list(json, "", "bufferViews", views);
  if (!good) return checker.error();
  if (buffers->empty()) return format_glb_file(json, "");
  std::string bin;
  std::vector<size_t> begins;  // Of each buffer in `bin`.
  for (const GltfJson& buffer : *buffers) {
    const std::string where = item_path("buffers", begins.size());
    std::string uri;
    if (!checker.is_object(buffer, where) || !checker.text(buffer, where, "uri", uri)) {
      return checker.error();
    }
    if (!buffer.contains("uri")) {
      return Error{path + ": " + where +
                   ": holds no data of its own; expected a file that needs no extension for it"};
    }
    Result<std::string> bytes = decode_data_uri(uri);
    if (!bytes) return Error{path + ": " + bytes.error().message};
    bin.resize((bin.size() + 3) / 4 * 4);
    begins.push_back(bin.size());
    bin += *bytes;
  }
  for (size_t v = 0; v < views->size(); ++v) {
    GltfJson& view = json["bufferViews"][v];
    const std::string where = item_path("bufferViews", v);
    int buffer = 0;
    uint64_t offset = 0;
    if (!checker.is_object(view, where) ||
        !checker.index(view, where, "buffer", begins.size(), buffer) ||
        !checker.count(view, where, "byteOffset", offset)) {
      return checker.error();
    }
    if (buffer < 0) return Error{path + ": " + where + ": expected a buffer, found none"};
    const size_t begin = begins[static_cast<size_t>(buffer)];
    if (begin > 0) view["byteOffset"] = begin + offset;
    view["buffer"] = 0;
  }
  json["buffers"] = {{{"byteLength", bin.size()}}};
  return format_glb_file(json, bin);
}

}  // namespace panache::cli
