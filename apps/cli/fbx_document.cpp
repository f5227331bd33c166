#include "fbx_document.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <system_error>

#include "clip/decimal.h"
#include "clip/text_cursor.h"

namespace panache::cli {
namespace {

constexpr int kMaxDepth = 64;                          // Real files have about ten levels.
constexpr const char* kNoWord = " \t\r\n\v\f,:;{}\"";  // Characters that end a word.

// "NAME:LINE:COLUMN: expected EXPECTED, found FOUND".
Error error_at(std::string_view text, size_t offset, const std::string& name,
               const std::string& expected, const std::string& found) {
  const std::string_view before = text.substr(0, offset);
  const auto line = 1 + std::count(before.begin(), before.end(), '\n');
  const size_t begin = before.rfind('\n') + 1;  // 0 in the first line.
  return {name + ":" + std::to_string(line) + ":" + std::to_string(offset - begin + 1) +
          ": expected " + expected + ", found " + found};
}

class Parser {
 public:
  Parser(std::string_view text, const std::string& name) : text_(text), name_(name) {}

  Result<void> read(FbxNode& root) {
    if (auto good = read_children(root, 0); !good) return good;
    if (!is_end()) return error("the end of the file");  // An unmatched closing brace.
    return {};
  }

 private:
  bool is_end() const { return at_ == text_.size(); }
  char here() const { return is_end() ? '\0' : text_[at_]; }

  void skip_space() {
    while (!is_end()) {
      if (here() == ';') {  // A comment.
        at_ = std::min(text_.find('\n', at_), text_.size());
      } else if (std::strchr(" \t\r\n\v\f", here())) {
        ++at_;
      } else {
        return;
      }
    }
  }

  std::string_view word() const {
    return text_.substr(at_, text_.find_first_of(kNoWord, at_) - at_);
  }

  // Whether the text continues with `Name:`.
  bool is_at_name() const {
    const size_t after = text_.find_first_not_of(" \t", at_ + word().size());
    return !word().empty() && after < text_.size() && text_[after] == ':';
  }

  Error error(const std::string& expected) const {
    const std::string_view here_is = word().empty() ? text_.substr(at_, 1) : word();
    return error_at(text_, at_, name_, expected,
                    is_end() ? "the end of the file" : panache::quoted(here_is));
  }

  Result<void> read_children(FbxNode& parent, int depth) {
    if (depth > kMaxDepth) return error("at most " + std::to_string(kMaxDepth) + " open braces");
    for (skip_space(); !is_end() && here() != '}'; skip_space()) {
      if (!is_at_name()) return error("a name with a colon behind it");
      FbxNode& node = parent.children.emplace_back();
      node.name = word();
      at_ = text_.find(':', at_) + 1;
      if (auto good = read_values(node); !good) return good;
      if (here() != '{') continue;
      ++at_;
      if (auto good = read_children(node, depth + 1); !good) return good;
      if (here() != '}') return error("'}'");
      ++at_;
    }
    return {};
  }

  // Values continue on the next line unless it begins with a name.
  Result<void> read_values(FbxNode& node) {
    for (skip_space(); !is_end(); skip_space()) {
      if (here() == ',') {
        ++at_;
      } else if (here() == '"') {
        const size_t end = text_.find('"', at_ + 1);
        if (end == std::string_view::npos) return error("a string with another '\"' at its end");
        node.values.push_back(text_.substr(at_ + 1, end - at_ - 1));
        at_ = end + 1;
      } else if (!word().empty() && !is_at_name()) {
        node.values.push_back(word());
        at_ += word().size();
      } else {
        return {};
      }
    }
    return {};
  }

  std::string_view text_;
  const std::string& name_;
  size_t at_ = 0;
};

static_assert(std::endian::native == std::endian::little);  // Same as the file.

constexpr std::string_view kBinaryStart = std::string_view("Kaydara FBX Binary  \0\x1a\0", 23);
constexpr size_t kBinaryHeader = 27;  // Magic and version.
constexpr size_t kNodeHeader = 13;    // End offset, number and size of values, name length.

// Converts binary nodes to text.
class BinaryReader {
 public:
  BinaryReader(std::string_view bytes, const std::string& path) : bytes_(bytes), path_(path) {}

  Result<std::string> read() {
    at_ = kBinaryHeader;
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

  // Reads nodes up to `end` or up to a nameless node, which ends a list.
  bool read_nodes(size_t end, int depth) {
    while (at_ < end) {
      uint32_t node_end = 0, count = 0, size = 0;
      uint8_t name_size = 0;
      const size_t begin = at_;
      if (!take(node_end, end) || !take(count, end) || !take(size, end) || !take(name_size, end)) {
        return false;
      }
      if (node_end == 0) return true;
      if (node_end > end || node_end < begin + kNodeHeader + name_size || depth > kMaxDepth ||
          size > node_end - begin - kNodeHeader - name_size) {
        return false;
      }
      const std::string_view name = bytes_.substr(at_, name_size);
      // A single word in text, too.
      if (name.empty() || name.find_first_of(kNoWord) != name.npos) return false;
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
        return read_string(end, false);  // Embedded pictures, which are not used.
      default:
        return false;
    }
  }

  // A boolean, or a key's interpolation.
  bool read_letter(size_t end) {
    uint8_t letter = 0;
    if (!take(letter, end)) return false;
    const bool is_letter = (letter >= 'A' && letter <= 'Z') || (letter >= 'a' && letter <= 'z');
    out_ += is_letter ? std::string(1, static_cast<char>(letter)) : std::to_string(letter);
    return true;
  }

  // "Hips\0\1Model" is "Model::Hips" in text form.
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

const FbxNode* FbxNode::child(std::string_view wanted) const {
  const auto found = std::find_if(children.begin(), children.end(),
                                  [&](const FbxNode& node) { return node.name == wanted; });
  return found == children.end() ? nullptr : &*found;
}

std::string_view FbxNode::value(size_t index) const {
  return index < values.size() ? values[index] : std::string_view();
}

Result<FbxDocument> FbxDocument::parse(std::string_view text, const std::string& name) {
  constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  FbxDocument out(text, name);
  if (auto good = Parser(out.text_, out.name_).read(out.root_); !good) return good.error();
  return out;
}

std::vector<const FbxNode*> FbxDocument::in_sections(std::string_view wanted) const {
  std::vector<const FbxNode*> out;
  for (const FbxNode& section : root_.children) {
    if (section.name != wanted) continue;
    for (const FbxNode& node : section.children) out.push_back(&node);
  }
  return out;
}

int FbxDocument::version() const {
  const FbxNode* header = root_.child("FBXHeaderExtension");
  const FbxNode* node = header ? header->child("FBXVersion") : nullptr;
  const std::string_view text = node ? node->value(0) : "";
  int out = 0;
  std::from_chars(text.data(), text.data() + text.size(), out);
  return out;
}

Error FbxDocument::error(std::string_view found, const std::string& expected) const {
  // Missing values have no position in the text.
  if (found.data() < text_.data() || found.data() > text_.data() + text_.size()) {
    return {name_ + ": expected " + expected + ", found nothing"};
  }
  return error_at(text_, static_cast<size_t>(found.data() - text_.data()), name_, expected,
                  panache::quoted(found));
}

Result<double> FbxDocument::number(std::string_view text, const std::string& of_what) const {
  double out = 0;
  const char* const end = text.data() + text.size();
  const auto [after, failure] = std::from_chars(text.data(), end, out);
  const bool is_tiny = failure == std::errc::result_out_of_range && std::abs(out) < 1;
  if (after == end && (failure == std::errc() || is_tiny) && std::abs(out) <= kLargestNumber) {
    return out;
  }
  return error(text, "a number between -1e9 and 1e9 for " + of_what);
}

Result<int64_t> FbxDocument::time(std::string_view text) const {
  int64_t out = 0;
  const char* const end = text.data() + text.size();
  const auto [after, failure] = std::from_chars(text.data(), end, out);
  if (after == end && failure == std::errc()) return out;
  return error(text, "a time, which is a whole number");
}

int binary_fbx_version(std::string_view bytes) {
  if (!bytes.starts_with(kBinaryStart) || bytes.size() < kBinaryHeader) return 0;
  int32_t version = 0;
  std::memcpy(&version, bytes.data() + kBinaryStart.size(), sizeof version);
  return version;
}

Result<std::string> fbx_text_of(std::string_view bytes, const std::string& path) {
  return BinaryReader(bytes, path).read();
}

}  // namespace panache::cli
