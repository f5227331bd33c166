#include "clip/gltf_container.h"

#include <algorithm>
#include <filesystem>

#include "base/file.h"
#include "base/bytes.h"
#include "clip/gltf_json.h"

namespace panache {
namespace {

constexpr uint32_t kMagic = 0x46546c67;      // "glTF"
constexpr uint32_t kJsonChunk = 0x4e4f534a;  // "JSON"
constexpr uint32_t kBinChunk = 0x004e4942;   // "BIN\0"
constexpr size_t kHeaderBytes = 12, kChunkHeaderBytes = 8;
// Half of the maximum 32-bit length of a GLB, which leaves room for new motion.
static_assert(kMaxFileBytes == uint64_t{1} << 31);
// For all other files together: a small file can refer to the same large one many times.
constexpr size_t kMaxFetchedBytes = size_t{1} << 30;

uint32_t read_uint32(std::string_view bytes, size_t at) {
  return static_cast<uint32_t>(little_endian(bytes.substr(at, 4)));
}

size_t padded(size_t size) { return (size + 3) / 4 * 4; }

void append_chunk(std::string& out, uint32_t type, std::string_view bytes, char padding) {
  append_little_endian(padded(bytes.size()), 4, out);
  append_little_endian(type, 4, out);
  out += bytes;
  out.append(padded(bytes.size()) - bytes.size(), padding);
}

class ContainerReader {
 public:
  ContainerReader(const std::string& name, GltfChecker& checker, GltfContainer& out)
      : name_(name), checker_(checker), out_(out), root_(out.json, checker) {}

  bool read(std::string_view bytes) {
    if (bytes.size() > kMaxFileBytes) {
      return checker_.fail(
          "", "expected at most 2 GB, found " + std::to_string(bytes.size()) + " bytes");
    }
    out_.size = bytes.size();
    out_.binary = bytes.size() >= 4 && read_uint32(bytes, 0) == kMagic;
    if (!(out_.binary ? read_chunks(bytes) : read_text(bytes))) return false;
    return check_version() && read_buffers() && embed_images();
  }

 private:
  bool read_text(std::string_view text) {
    constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
    if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
    const size_t line_end = text.find('\n');
    if (line_end != std::string_view::npos && line_end + 1 < text.size()) {
      const size_t first = std::min(text.find_first_not_of(" \t", line_end + 1), text.size());
      out_.indent = static_cast<int>(std::min<size_t>(first - line_end - 1, 8));
      if (text[line_end + 1] == '\t') out_.indent_char = '\t';
    }
    return checker_.parse(text, out_.json);
  }

  bool read_chunks(std::string_view bytes) {
    if (bytes.size() < kHeaderBytes) return incomplete(kHeaderBytes, bytes.size());
    if (const uint32_t version = read_uint32(bytes, 4); version != 2) {
      return checker_.fail("", "expected GLB version 2, found version " + std::to_string(version));
    }
    const size_t length = read_uint32(bytes, 8);
    if (length > bytes.size()) return incomplete(length, bytes.size());
    bool has_json = false;
    for (size_t at = kHeaderBytes; at < length;) {
      if (length - at < kChunkHeaderBytes) return incomplete(at + kChunkHeaderBytes, length);
      const size_t size = read_uint32(bytes, at);
      const uint32_t type = read_uint32(bytes, at + 4);
      at += kChunkHeaderBytes;
      if (size > length - at) return incomplete(at + size, length);
      const std::string_view chunk = bytes.substr(at, size);
      at += size;
      if (!has_json) {
        if (type != kJsonChunk) {
          return checker_.fail("", "expected JSON as the first chunk of the GLB, found another");
        }
        has_json = true;
        if (!checker_.parse(chunk, out_.json)) return false;
      } else if (type == kBinChunk && !out_.has_bin) {
        out_.has_bin = true;
        bin_ = chunk;
      } else {
        out_.other_chunks.emplace_back(type, chunk);
      }
    }
    return has_json || checker_.fail("", "expected a GLB with a JSON chunk, found none");
  }

  bool incomplete(size_t expected, size_t found) {
    return checker_.fail("", "expected a GLB of " + std::to_string(expected) +
                                 " bytes at least, found " + std::to_string(found) +
                                 "; is the file complete?");
  }

  bool check_version() {
    const GltfPart asset = root_.object("asset");
    if (!asset) return asset.fail("expected glTF's version in it, found nothing");
    const std::string version = asset.text("version"), needed = asset.text("minVersion");
    if (version.starts_with("2.") && (needed.empty() || needed == "2.0")) return checker_.ok();
    return asset.fail("expected glTF version 2.0, found '" +
                      (needed.empty() ? version : needed).substr(0, 20) + "'");
  }

  // Reads the bytes at the uri of `json`, whose path is `path`. A reference to another file becomes
  // a data URI of `type`, or of the type that its bytes indicate.
  bool fetch(GltfJson& json, const std::string& path, const std::string& type, std::string& bytes) {
    std::string& uri = json["uri"].get_ref<std::string&>();
    const auto fail = [&](const std::string& message) {
      return checker_.fail(path + ".uri", message);
    };
    if (is_data_uri(uri)) {
      auto decoded = decode_data_uri(uri);
      if (!decoded) return fail(decoded.error().message);
      bytes = *std::move(decoded);
      return true;
    }
    auto file = resolve_uri(uri, name_);
    if (!file) return fail(file.error().message);
    auto content = read_file(*file);
    if (!content) return fail(content.error().message);
    bytes = *std::move(content);
    fetched_ += bytes.size();
    out_.size += bytes.size();
    if (fetched_ > kMaxFetchedBytes) {
      return fail("expected at most 1 GB in other files in all, found more");
    }
    uri = make_data_uri(type.empty() ? image_type(bytes) : type, bytes);
    return true;
  }

  static std::string image_type(std::string_view bytes) {
    if (bytes.starts_with("\x89PNG")) return "image/png";
    if (bytes.starts_with("\xff\xd8")) return "image/jpeg";
    if (bytes.starts_with("RIFF")) return "image/webp";
    if (bytes.starts_with("\xabKTX")) return "image/ktx2";
    return "application/octet-stream";
  }

  bool read_buffers() {
    const std::vector<GltfPart> list = root_.list("buffers");
    if (list.empty() || !list[0].text("uri").empty()) out_.has_bin = false;
    for (size_t i = 0; i < list.size(); ++i) {
      if (!read_buffer(list[i], out_.json["buffers"][i], i == 0)) return false;
    }
    return checker_.ok();
  }

  bool read_buffer(const GltfPart& buffer, GltfJson& json, bool first) {
    const uint64_t length = buffer.count("byteLength");
    if (checker_.ok() && !json.contains("byteLength")) {
      return buffer.fail("expected a byteLength, found none");
    }
    const bool has_uri = !buffer.text("uri").empty();
    if (!checker_.ok()) return false;
    if (!has_uri && !(first && out_.has_bin)) {
      out_.buffers.emplace_back();
      return true;
    }
    std::string bytes;
    if (!has_uri) {
      bytes = bin_;
    } else if (!fetch(json, buffer.path(), "application/octet-stream", bytes)) {
      return false;
    }
    if (bytes.size() < length) {
      return buffer.fail("expected " + std::to_string(length) + " bytes, found " +
                         std::to_string(bytes.size()));
    }
    bytes.resize(length);
    out_.buffers.emplace_back(std::move(bytes));
    return true;
  }

  bool embed_images() {
    const std::vector<GltfPart> list = root_.list("images");
    for (size_t i = 0; i < list.size(); ++i) {
      const std::string uri = list[i].text("uri"), type = list[i].text("mimeType");
      if (!checker_.ok()) return false;
      if (uri.empty() || is_data_uri(uri)) continue;  // Pictures are not examined.
      // Motion does not need it, so a missing picture, or one elsewhere, stays a reference.
      const auto file = resolve_uri(uri, name_);
      std::error_code unknown;
      if (!file || !std::filesystem::is_regular_file(*file, unknown)) continue;
      std::string bytes;
      if (!fetch(out_.json["images"][i], list[i].path(), type, bytes)) return false;
    }
    return checker_.ok();
  }

  const std::string& name_;
  GltfChecker& checker_;
  GltfContainer& out_;
  GltfPart root_;
  std::string_view bin_;
  size_t fetched_ = 0;  // Bytes read from other files.
};

}  // namespace

// The bytes are freed before the rest is read. NOLINTNEXTLINE(performance-unnecessary-value-param)
bool read_gltf_container(std::string bytes, const std::string& name, GltfChecker& checker,
                         GltfContainer& out) {
  return ContainerReader(name, checker, out).read(bytes);
}

std::string_view GltfContainer::bytes_of(const GltfPart& view) const {
  const int buffer = view.index("buffer", buffers.size());
  const uint64_t at = view.count("byteOffset"), length = view.count("byteLength");
  if (buffer < 0 || !buffers[buffer]) {
    view.fail("expected a buffer with data, found none");
    return {};
  }
  const std::string_view bytes = *buffers[buffer];
  if (at <= bytes.size() && length <= bytes.size() - at) return bytes.substr(at, length);
  view.fail("expected a part of the " + std::to_string(bytes.size()) + " bytes of buffers[" +
            std::to_string(buffer) + "], found " + std::to_string(length) + " bytes from byte " +
            std::to_string(at) + " on");
  return {};
}

GltfPosition gltf_added_at(const GltfContainer& container) {
  if (container.has_bin) return {0, padded(container.buffers[0]->size())};
  return {container.buffers.size(), 0};
}

std::string write_gltf_container(const GltfContainer& container, GltfJson json,
                                 const std::string& added) {
  std::string bin;
  bool has_bin = container.has_bin;
  if (has_bin) bin = *container.buffers[0];
  if (!added.empty()) {
    const GltfPosition added_at = gltf_added_at(container);
    // In a GLB the first buffer is the chunk; a new chunk cannot come before existing buffers.
    if (container.binary && added_at.buffer == 0) {
      has_bin = true;
      bin.resize(added_at.offset);
      bin += added;
      json["buffers"][0]["byteLength"] = bin.size();
    } else {
      json["buffers"].push_back({{"byteLength", added.size()},
                                 {"uri", make_data_uri("application/octet-stream", added)}});
    }
  }
  constexpr auto kReplace = GltfJson::error_handler_t::replace;
  if (!container.binary) return json.dump(container.indent, container.indent_char, false, kReplace);

  std::string body;
  append_chunk(body, kJsonChunk, json.dump(-1, ' ', false, kReplace), ' ');
  if (has_bin) append_chunk(body, kBinChunk, bin, '\0');
  for (const auto& [type, bytes] : container.other_chunks) append_chunk(body, type, bytes, '\0');
  std::string out;
  out.reserve(kHeaderBytes + body.size());
  append_little_endian(kMagic, 4, out);
  append_little_endian(2, 4, out);
  append_little_endian(kHeaderBytes + body.size(), 4, out);
  return out += body;
}

}  // namespace panache
