#include "fbx_binary.h"

#include <bit>
#include <charconv>
#include <cstdint>
#include <cstring>

namespace panache::cli {
namespace {

static_assert(std::endian::native == std::endian::little);  // As the file.

constexpr std::string_view kStart = std::string_view("Kaydara FBX Binary  \0\x1a\0", 23);
constexpr size_t kHeader = 27;      // The start and the version.
constexpr size_t kNodeHeader = 13;  // End, count and bytes of the values, length of the name.
constexpr int kDeepest = 64;

class Reader {
 public:
  Reader(std::string_view bytes, const std::string& path) : bytes_(bytes), path_(path) {}

  Result<std::string> read() {
    at_ = kHeader;
    if (!read_nodes(bytes_.size(), 0)) {
      return Error{path_ + ": expected binary FBX, found something else at byte " +
                   std::to_string(at_) + "; is the file complete?"};
    }
    return std::move(out_);
  }

 private:
  template <class T>
  bool take(T& value, size_t end) {
    if (end - at_ < sizeof value) return false;
    std::memcpy(&value, bytes_.data() + at_, sizeof value);
    at_ += sizeof value;
    return true;
  }

  // Nodes up to one without a name, which ends a list, or up to `end`.
  bool read_nodes(size_t end, int depth) {
    while (at_ < end) {
      uint32_t node_end = 0, count = 0, size = 0;
      uint8_t name_size = 0;
      const size_t begin = at_;
      if (!take(node_end, end) || !take(count, end) || !take(size, end) || !take(name_size, end)) {
        return false;
      }
      if (node_end == 0) return true;
      if (node_end > end || node_end < begin + kNodeHeader + name_size || depth > kDeepest ||
          size > node_end - begin - kNodeHeader - name_size) {
        return false;
      }
      const std::string_view name = bytes_.substr(at_, name_size);
      // It is a word in the text, too.
      if (name.empty() || name.find_first_of(" \t\r\n\v\f,:;{}\"") != name.npos) return false;
      out_.append(name).append(": ");
      at_ += name_size;
      const size_t values_end = at_ + size;
      for (uint32_t i = 0; i < count; ++i) {
        if (i > 0) out_ += ',';
        if (!read_value(values_end)) return false;
      }
      if (at_ != values_end) return false;
      if (at_ < node_end) {
        out_ += " {\n";
        if (!read_nodes(node_end, depth + 1)) return false;
        out_ += '}';
      }
      if (at_ != node_end) return false;
      out_ += '\n';
    }
    return true;
  }

  template <class T>
  bool read_number(size_t end) {
    T value = 0;
    if (!take(value, end)) return false;
    char text[32];
    out_.append(text, std::to_chars(text, text + sizeof text, value).ptr);
    return true;
  }

  bool read_value(size_t end) {
    char type = 0;
    if (!take(type, end)) return false;
    switch (type) {
      case 'Y':
        return read_number<int16_t>(end);
      case 'I':
        return read_number<int32_t>(end);
      case 'L':
        return read_number<int64_t>(end);
      case 'F':
        return read_number<float>(end);
      case 'D':
        return read_number<double>(end);
      case 'C':
        return read_letter(end);
      case 'S':
        return read_string(end, true);
      case 'R':
        return read_string(end, false);  // Pictures, which nobody wants here.
      default:
        return false;
    }
  }

  // A truth value, or how a key goes on.
  bool read_letter(size_t end) {
    uint8_t letter = 0;
    if (!take(letter, end)) return false;
    const bool is_letter = (letter >= 'A' && letter <= 'Z') || (letter >= 'a' && letter <= 'z');
    out_ += is_letter ? std::string(1, static_cast<char>(letter)) : std::to_string(letter);
    return true;
  }

  // "Hips\0\1Model" is "Model::Hips" in text.
  bool read_string(size_t end, bool is_wanted) {
    uint32_t size = 0;
    if (!take(size, end) || size > end - at_) return false;
    std::string text(is_wanted ? bytes_.substr(at_, size) : "");
    at_ += size;
    const size_t middle = text.find(std::string_view("\0\x01", 2));
    if (middle != text.npos) text = text.substr(middle + 2) + "::" + text.substr(0, middle);
    for (char& c : text) {
      if (c == '"' || c == '\0') c = '_';
    }
    out_ += '"' + text + '"';
    return true;
  }

  const std::string_view bytes_;
  const std::string& path_;
  size_t at_ = 0;
  std::string out_;
};

}  // namespace

int binary_fbx_version(std::string_view bytes) {
  if (!bytes.starts_with(kStart) || bytes.size() < kHeader) return 0;
  int32_t version = 0;
  std::memcpy(&version, bytes.data() + kStart.size(), sizeof version);
  return version;
}

Result<std::string> fbx_text_of(std::string_view bytes, const std::string& path) {
  return Reader(bytes, path).read();
}

}  // namespace panache::cli
