#include "clip/gltf_json.h"

#include <array>
#include <cstdint>
#include <filesystem>

#include "clip/text_cursor.h"

namespace panache {
namespace {

constexpr std::string_view kDigits =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

constexpr std::array<int8_t, 256> digit_values() {
  std::array<int8_t, 256> values = {};
  for (int8_t& value : values) value = -1;
  for (size_t i = 0; i < kDigits.size(); ++i) {
    values[static_cast<unsigned char>(kDigits[i])] = static_cast<int8_t>(i);
  }
  return values;
}

Result<std::string> decode_base64(std::string_view text) {
  static constexpr std::array<int8_t, 256> kValues = digit_values();
  while (!text.empty() && text.back() == '=') text.remove_suffix(1);
  std::string bytes;
  bytes.reserve(text.size() / 4 * 3 + 3);
  uint32_t bits = 0;
  int held = 0;  // Bits not yet written.
  for (const char c : text) {
    const int value = kValues[static_cast<unsigned char>(c)];
    if (value < 0) return Error{"expected base64, found " + quoted(std::string_view(&c, 1))};
    bits = bits << 6 | static_cast<uint32_t>(value);
    held += 6;
    if (held < 8) continue;
    held -= 8;
    bytes += static_cast<char>(bits >> held & 0xff);
  }
  return bytes;
}

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

std::string percent_decoded(std::string_view text) {
  std::string out;
  for (size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '%' && i + 2 < text.size()) {
      const int high = hex_digit(text[i + 1]), low = hex_digit(text[i + 2]);
      if (high >= 0 && low >= 0) {
        out += static_cast<char>(high << 4 | low);
        i += 2;
        continue;
      }
    }
    out += text[i];
  }
  return out;
}

// Whether it starts with "http:", "file:" or the like; a colon after a slash belongs to a name.
bool has_scheme(std::string_view uri) {
  const size_t colon = uri.find(':');
  return colon != std::string_view::npos && colon < uri.find('/');
}

}  // namespace

bool is_data_uri(std::string_view uri) { return uri.starts_with("data:"); }

Result<std::string> decode_data_uri(std::string_view uri) {
  const size_t comma = uri.find(',');
  if (comma == std::string_view::npos) {
    return Error{"expected a data URI with a comma before its data, found none"};
  }
  const std::string_view data = uri.substr(comma + 1);
  if (uri.substr(0, comma).ends_with(";base64")) return decode_base64(data);
  return percent_decoded(data);
}

std::string make_data_uri(std::string_view type, std::string_view bytes) {
  std::string uri = "data:";
  uri.reserve(uri.size() + type.size() + 8 + (bytes.size() + 2) / 3 * 4);
  uri += type;
  uri += ";base64,";
  for (size_t i = 0; i < bytes.size(); i += 3) {
    const size_t count = std::min<size_t>(3, bytes.size() - i);
    uint32_t bits = 0;
    for (size_t k = 0; k < 3; ++k) {
      bits = bits << 8 | (k < count ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    }
    for (size_t k = 0; k < 4; ++k) {
      uri += k <= count ? kDigits[bits >> (18 - 6 * k) & 63] : '=';
    }
  }
  return uri;
}

Result<std::string> resolve_uri(std::string_view uri, const std::string& path) {
  const std::string relative = percent_decoded(uri);
  const auto rejected = [&](const std::string& expected) {
    return Error{"expected " + expected + ", found " + quoted(uri) +
                 "; save the file as .glb, which has everything in it"};
  };
  if (has_scheme(uri)) return rejected("a file beside this one or a data URI");
  if (relative.empty() || relative.find('\0') != std::string::npos) {
    return rejected("the name of a file");
  }
  const std::filesystem::path file(relative);
  if (file.is_absolute()) return rejected("a name relative to this file");
  for (const std::filesystem::path& part : file) {
    if (part == "..") return rejected("a file beside or below this one");
  }
  return (std::filesystem::path(path).parent_path() / file).string();
}

}  // namespace panache
