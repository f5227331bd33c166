// The nodes of a binary FBX file: where each ends, how many values it has, their bytes, its name,
// the values, then its children with an empty node behind them.

#include "base/little_endian.h"
#include "clip/fbx_tree.h"

namespace panache {
namespace {

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

}  // namespace panache
