#include "clip/fbx_tree.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <optional>

#include <fast_float/fast_float.h>

#include "base/inflate.h"
#include "base/bytes.h"
#include "clip/text_cursor.h"

namespace panache {
namespace {

constexpr size_t kLargestFbx = size_t{1} << 30;  // Bytes.

bool is_within(double number) { return std::abs(number) <= kLargestNumber; }

bool to_number(std::string_view word, double& out) {
  if (word.starts_with('+')) word.remove_prefix(1);
  const char* const end = word.data() + word.size();
  return fast_float::from_chars(word.data(), end, out).ptr == end && !word.empty() &&
         is_within(out);
}

bool to_number(std::string_view word, int64_t& out) {
  const char* const end = word.data() + word.size();
  const auto [after, failure] = std::from_chars(word.data(), end, out);
  return after == end && failure == std::errc();
}

// The number in the bytes of a binary value, or of an element of an array.
std::optional<int64_t> whole(char type, std::string_view bytes) {
  const uint64_t bits = little_endian(bytes);
  switch (type) {
    case 'C':
    case 'B':
    case 'b':
    case 'c':
      return static_cast<int64_t>(bits);
    case 'Y':
      return static_cast<int16_t>(bits);
    case 'I':
    case 'i':
      return static_cast<int32_t>(bits);
    case 'L':
    case 'l':
      return static_cast<int64_t>(bits);
    default:
      return {};
  }
}

bool from_binary(char type, std::string_view bytes, int64_t& out) {
  const std::optional<int64_t> integer = whole(type, bytes);
  if (integer) out = *integer;
  return integer.has_value();
}

bool from_binary(char type, std::string_view bytes, double& out) {
  if (type == 'F' || type == 'f') {
    out = std::bit_cast<float>(static_cast<uint32_t>(little_endian(bytes)));
  } else if (type == 'D' || type == 'd') {
    out = std::bit_cast<double>(little_endian(bytes));
  } else if (const std::optional<int64_t> integer = whole(type, bytes)) {
    out = static_cast<double>(*integer);
  } else {
    return false;
  }
  return is_within(out);
}

bool from_binary(char type, std::string_view bytes, float& out) {
  if (type == 'f') {
    out = std::bit_cast<float>(static_cast<uint32_t>(little_endian(bytes)));
    return true;
  }
  double number = 0;
  if (!from_binary(type, bytes, number)) return false;
  out = static_cast<float>(number);
  return true;
}

bool to_number(std::string_view word, float& out) {
  double number = 0;
  if (!to_number(word, number)) return false;
  out = static_cast<float>(number);
  return true;
}

template <class T>
bool from_value(const FbxValue& value, T& out) {
  if (value.type == 'w' || value.type == '"') return to_number(value.bytes, out);
  if (value.type == 'S' || value.type == 'R') return false;
  return std::string_view("bcilfd").find(value.type) == std::string_view::npos &&
         from_binary(value.type, value.bytes, out);
}

bool is_array(const FbxNode& node) {
  return node.values.size() == 1 &&
         std::string_view("bcilfd").find(node.values[0].type) != std::string_view::npos;
}

template <class T>
bool read_array(const FbxValue& value, std::vector<T>& out) {
  const auto header = [&](size_t which) { return little_endian(value.bytes.substr(4 * which, 4)); };
  const size_t count = header(0);
  const size_t element = std::string_view("bc").find(value.type) != std::string_view::npos ? 1
                         : value.type == 'i' || value.type == 'f'                          ? 4
                                                                                           : 8;
  std::string_view data = value.bytes.substr(kFbxArrayHeader);
  std::optional<std::string> unpacked;
  if (header(1) != 0) {
    unpacked = header(1) == 1 ? inflate(data, count * element) : std::nullopt;
    if (!unpacked) return false;
    data = *unpacked;
  }
  out.resize(count);
  for (size_t i = 0; i < count; ++i) {
    if (!from_binary(value.type, data.substr(element * i, element), out[i])) return false;
  }
  return true;
}

bool is_letter(char c) { return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z'); }

// Text files begin with a comment or with their first section.
bool begins_as_text(std::string_view bytes) {
  const std::string_view start = bytes.substr(0, 4096);
  return start.find("FBX") != start.npos && start.find('\0') == start.npos;
}

}  // namespace

const FbxNode* FbxNode::child(std::string_view wanted) const {
  const auto found = std::find_if(children.begin(), children.end(),
                                  [&](const FbxNode& node) { return node.name == wanted; });
  return found == children.end() ? nullptr : &*found;
}

Result<FbxTree> FbxTree::parse(std::string bytes, std::string name) {
  if (bytes.size() > kLargestFbx) {
    return Error{name + ": is larger than 1 GB; expected a smaller FBX file, or the same as GLB"};
  }
  FbxTree tree(std::move(bytes), std::move(name));
  const std::string_view all = tree.bytes();
  tree.version_ = binary_fbx_version(all);
  tree.is_binary_ = tree.version_ > 0;
  if (!tree.is_binary_ && !begins_as_text(all)) {
    return Error{tree.name_ + ": does not begin as FBX files do; is it damaged?"};
  }
  const auto parse = tree.is_binary_ ? parse_fbx_binary : parse_fbx_text;
  if (auto good = parse(all, tree.name_, tree.root_); !good) return good.error();
  if (!tree.is_binary_) {
    const FbxNode* header = tree.root_.child("FBXHeaderExtension");
    const FbxNode* node = header ? header->child("FBXVersion") : nullptr;
    int64_t version = 0;
    if (node && tree.integer(*node, 0, version) && version > 0 && version < 100'000) {
      tree.version_ = static_cast<int>(version);
    }
  }
  return tree;
}

std::vector<const FbxNode*> FbxTree::in_sections(std::string_view wanted) const {
  std::vector<const FbxNode*> out;
  for (const FbxNode& section : root_.children) {
    if (section.name != wanted) continue;
    for (const FbxNode& node : section.children) out.push_back(&node);
  }
  return out;
}

std::string FbxTree::text(const FbxNode& node, size_t which) const {
  if (which >= node.values.size()) return "";
  const FbxValue& value = node.values[which];
  // The interpolation of a key, in FBX 6.
  if (value.type == 'C' && is_letter(value.bytes[0])) return std::string(value.bytes);
  if (value.type != 'w' && value.type != '"' && value.type != 'S' && value.type != 'R') {
    int64_t integer = 0;
    double number = 0;
    if (from_value(value, integer)) return std::to_string(integer);
    return from_value(value, number) ? with_decimals(number, 6) : "";
  }
  std::string out(value.bytes);
  const size_t middle = out.find(std::string_view("\0\x01", 2));
  if (is_binary_ && middle != out.npos) out = out.substr(middle + 2) + "::" + out.substr(0, middle);
  return out;
}

bool FbxTree::integer(const FbxNode& node, size_t which, int64_t& out) const {
  return which < node.values.size() && from_value(node.values[which], out);
}

bool FbxTree::number(const FbxNode& node, size_t which, double& out) const {
  return which < node.values.size() && from_value(node.values[which], out);
}

template <class T>
bool FbxTree::array(const FbxNode* node, std::vector<T>& out) const {
  out.clear();
  if (!node) return true;
  if (is_array(*node)) return read_array(node->values[0], out);
  if (const FbxNode* inner = node->child("a")) node = inner;
  out.resize(node->values.size());
  for (size_t i = 0; i < out.size(); ++i) {
    if (!from_value(node->values[i], out[i])) return false;
  }
  return true;
}

bool FbxTree::integers(const FbxNode* node, std::vector<int64_t>& out) const {
  return array(node, out);
}
bool FbxTree::numbers(const FbxNode* node, std::vector<double>& out) const {
  return array(node, out);
}

bool FbxTree::raw_floats(const FbxNode* node, std::vector<float>& out) const {
  return array(node, out);
}

Error FbxTree::error(const FbxNode& at, const std::string& expected,
                     const std::string& found) const {
  const std::string where = is_binary_ ? name_ + ": byte " + std::to_string(at.begin)
                                       : fbx_position(bytes(), at.begin, name_);
  return {where + ": expected " + expected + ", found " + found};
}

Error FbxTree::error(const FbxNode& at, size_t which, const std::string& expected) const {
  const bool is_there = which < at.values.size();
  return error(at, expected, is_there ? panache::quoted(text(at, which)) : "nothing");
}

}  // namespace panache
