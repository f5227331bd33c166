// The two forms of an FBX file, read to the same tree of nodes.

#include <algorithm>
#include <cstring>

#include "base/bytes.h"
#include "clip/fbx_tree.h"
#include "clip/text_cursor.h"

namespace panache {

namespace {

// Of each node a binary file says where it ends, how many values it has and their bytes, its name,
// the values, then its children with an empty node behind them.

constexpr std::string_view kFbxBinaryStart = std::string_view("Kaydara FBX Binary  \0\x1a\0", 23);
constexpr size_t kFbxBinaryHeader = 27;  // Magic and version.

class FbxBinaryParser {
 public:
  FbxBinaryParser(std::string_view bytes, int version)
      : bytes_(bytes), number_size_(version < kFbxWideVersion ? 4 : 8) {}

  bool read(FbxNode& root) {
    at_ = kFbxBinaryHeader;
    root.begin = at_;
    return read_list(root, bytes_.size(), 0);
  }
  size_t at() const { return at_; }

 private:
  bool take(uint64_t& value, size_t size, size_t end) {
    if (end - at_ < size) return false;
    value = little_endian(bytes_.substr(at_, size));
    at_ += size;
    return true;
  }

  // Reads nodes up to `end` or up to an empty node.
  bool read_list(FbxNode& parent, size_t end, int depth) {
    parent.has_list = true;
    if (depth > kFbxMaxDepth) return false;
    while (true) {
      parent.list_end = parent.end = at_;
      if (at_ == end) return true;
      FbxNode node;
      node.begin = at_;
      uint64_t node_end = 0, count = 0, size = 0, name_size = 0;
      if (!take(node_end, number_size_, end) || !take(count, number_size_, end) ||
          !take(size, number_size_, end) || !take(name_size, 1, end)) {
        return false;
      }
      if (node_end == 0) return true;
      if (node_end > end || node_end < at_ || name_size > node_end - at_ ||
          size > node_end - at_ - name_size || ++nodes_ > kFbxMaxNodes) {
        return false;
      }
      node.end = node_end;
      node.name = bytes_.substr(at_, name_size);
      // A single word, as in text.
      if (node.name.empty() || node.name.find_first_of(kFbxNoWord) != node.name.npos) return false;
      at_ += name_size;
      const size_t values_end = at_ + size;
      for (uint64_t i = 0; i < count; ++i) {
        if (!read_value(node, values_end)) return false;
      }
      if (at_ != values_end) return false;
      node.list_end = at_;
      if (at_ < node.end && !read_list(node, node_end, depth + 1)) return false;
      if (at_ != node_end) return false;
      node.end = node_end;
      parent.children.push_back(std::move(node));
    }
  }

  bool read_value(FbxNode& node, size_t end) {
    uint64_t type = 0, size = 0;
    if (!take(type, 1, end)) return false;
    const size_t begin = at_;
    switch (static_cast<char>(type)) {
      case 'C':
      case 'B':
        size = 1;
        break;
      case 'Y':
        size = 2;
        break;
      case 'I':
      case 'F':
        size = 4;
        break;
      case 'L':
      case 'D':
        size = 8;
        break;
      case 'S':
      case 'R':
        if (!take(size, 4, end) || size > end - at_) return false;
        node.values.push_back({static_cast<char>(type), bytes_.substr(at_, size)});
        at_ += size;
        return true;
      case 'b':
      case 'c':
      case 'i':
      case 'l':
      case 'f':
      case 'd': {
        if (end - at_ < kFbxArrayHeader) return false;
        const auto header = [&](size_t which) {
          return little_endian(bytes_.substr(begin + 4 * which, 4));
        };
        const uint64_t element = type == 'b' || type == 'c'   ? 1
                                 : type == 'i' || type == 'f' ? 4
                                                              : 8;
        size = kFbxArrayHeader + (header(1) == 0 ? header(0) * element : header(2));
        break;
      }
      default:
        return false;
    }
    if (size > end - at_) return false;
    node.values.push_back({static_cast<char>(type), bytes_.substr(at_, size)});
    at_ += size;
    return true;
  }

  const std::string_view bytes_;
  const size_t number_size_;
  size_t at_ = 0;
  size_t nodes_ = 0;
};

}  // namespace

int binary_fbx_version(std::string_view bytes) {
  if (!bytes.starts_with(kFbxBinaryStart) || bytes.size() < kFbxBinaryHeader) return 0;
  const uint64_t version = little_endian(bytes.substr(kFbxBinaryStart.size(), 4));
  return version < 100'000 ? static_cast<int>(version) : 0;
}

Result<void> parse_fbx_binary(std::string_view bytes, const std::string& name, FbxNode& root) {
  FbxBinaryParser parser(bytes, binary_fbx_version(bytes));
  if (parser.read(root)) return {};
  return Error{name + ": expected binary FBX, found something else at byte " +
               std::to_string(parser.at()) + "; is the file complete?"};
}

namespace {

class FbxTextParser {
 public:
  FbxTextParser(std::string_view text, const std::string& name) : text_(text), name_(name) {}

  Result<void> read(FbxNode& root) {
    if (text_.starts_with("\xef\xbb\xbf")) at_ = 3;
    root.begin = at_;
    if (const size_t zero = text_.find('\0'); zero != text_.npos) {
      return Error{fbx_position(text_, zero, name_) +
                   ": expected text, found a byte of 0; is the file damaged?"};
    }
    if (auto good = read_children(root, 0); !good) return good;
    if (!is_end()) return error("the end of the file");  // An unmatched closing brace.
    root.end = at_;
    return {};
  }

 private:
  bool is_end() const { return at_ == text_.size(); }
  char here() const { return is_end() ? '\0' : text_[at_]; }

  void skip_space() {
    while (!is_end()) {
      if (here() == ';') {  // A comment.
        at_ = std::min(text_.find('\n', at_), text_.size());
      } else if (here() != '\0' && std::strchr(" \t\r\n\v\f", here())) {
        ++at_;
      } else {
        return;
      }
    }
  }

  std::string_view word() const {
    return text_.substr(at_, text_.find_first_of(kFbxNoWord, at_) - at_);
  }

  // Whether the text continues with `Name:`.
  bool is_at_name() const {
    const size_t after = text_.find_first_not_of(" \t", at_ + word().size());
    return !word().empty() && after < text_.size() && text_[after] == ':';
  }

  Error error(const std::string& expected) const {
    const std::string_view here_is = word().empty() ? text_.substr(at_, 1) : word();
    return {fbx_position(text_, at_, name_) + ": expected " + expected + ", found " +
            (is_end() ? "the end of the file" : panache::quoted(here_is))};
  }

  Result<void> read_children(FbxNode& parent, int depth) {
    if (depth > kFbxMaxDepth) {
      return error("at most " + std::to_string(kFbxMaxDepth) + " open braces");
    }
    parent.has_list = true;
    for (skip_space(); !is_end() && here() != '}'; skip_space()) {
      if (!is_at_name()) return error("a name with a colon behind it");
      if (++nodes_ > kFbxMaxNodes) {
        return error("at most " + std::to_string(kFbxMaxNodes) + " names");
      }
      FbxNode& node = parent.children.emplace_back();
      node.begin = at_;
      node.name = word();
      at_ = node.end = text_.find(':', at_) + 1;
      if (auto good = read_values(node); !good) return good;
      if (here() != '{') continue;
      ++at_;
      if (auto good = read_children(node, depth + 1); !good) return good;
      if (here() != '}') return error("'}'");
      node.end = ++at_;
    }
    parent.list_end = at_;
    return {};
  }

  // Values continue on the next line unless it begins with a name.
  Result<void> read_values(FbxNode& node) {
    for (skip_space(); !is_end(); skip_space()) {
      if (here() == ',') {
        node.end = ++at_;  // Also without a value behind it: what replaces the node replaces it.
      } else if (here() == '"') {
        const size_t end = text_.find('"', at_ + 1);
        if (end == std::string_view::npos) return error("a string with another '\"' at its end");
        node.values.push_back({'"', text_.substr(at_ + 1, end - at_ - 1)});
        at_ = node.end = end + 1;
      } else if (!word().empty() && !is_at_name()) {
        node.values.push_back({'w', word()});
        at_ += word().size();
        node.end = at_;
      } else {
        return {};
      }
    }
    return {};
  }

  std::string_view text_;
  const std::string& name_;
  size_t at_ = 0;
  size_t nodes_ = 0;
};

}  // namespace

std::string fbx_position(std::string_view text, size_t offset, const std::string& name) {
  const std::string_view before = text.substr(0, offset);
  const auto line = 1 + std::count(before.begin(), before.end(), '\n');
  const size_t begin = before.rfind('\n') + 1;  // 0 in the first line.
  return name + ":" + std::to_string(line) + ":" + std::to_string(offset - begin + 1);
}

Result<void> parse_fbx_text(std::string_view text, const std::string& name, FbxNode& root) {
  return FbxTextParser(text, name).read(root);
}

}  // namespace panache
