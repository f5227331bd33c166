#include "clip/fbx_writer.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstdio>
#include <cstring>

#include "base/bytes.h"

namespace panache {
namespace {

constexpr int kNewVersion = 7400;
constexpr std::string_view kNewStart = std::string_view("Kaydara FBX Binary  \0\x1a\0", 23);
// The end of a binary file: an ID, zeros up to a multiple of 16, the version, zeros, another ID.
constexpr std::string_view kFooterId =
    "\xfa\xbc\xab\x09\xd0\xc8\xd4\x66\xb1\x76\xfb\x83\x1c\xf7\x26\x7e";
constexpr std::string_view kLastId =
    "\xf8\x5a\x8c\x6a\xde\xf5\xd9\x7e\xec\xe9\x0c\xe3\x75\x8f\x29\x0b";
constexpr size_t kFooterZeros = 120, kAlignment = 16;

std::string exact(double number, const char* format) {
  char text[40];
  std::snprintf(text, sizeof text, format, number);
  for (char& c : text) {
    if (c == ',') c = '.';  // Of a locale.
  }
  return text;
}
std::string exact(double number) { return exact(number, "%.17g"); }
std::string exact(float number) { return exact(static_cast<double>(number), "%.9g"); }
std::string exact(int32_t number) { return std::to_string(number); }
std::string exact(int64_t number) { return std::to_string(number); }

uint64_t bits_of(double number) { return std::bit_cast<uint64_t>(number); }
uint64_t bits_of(float number) { return std::bit_cast<uint32_t>(number); }
uint64_t bits_of(int32_t number) { return static_cast<uint32_t>(number); }
uint64_t bits_of(int64_t number) { return static_cast<uint64_t>(number); }

void append_footer(std::string_view id, uint64_t version, std::string& out) {
  out += id;
  out.append(4, '\0');
  out.append(kAlignment - out.size() % kAlignment, '\0');
  append_little_endian(version, 4, out);
  out.append(kFooterZeros, '\0');
  out += kLastId;
}

// The footer of a file whose nodes have moved.
void append_moved_footer(std::string_view footer, std::string& out) {
  const size_t tail = 4 + kFooterZeros + kLastId.size();
  if (footer.size() < kFooterId.size() + tail || !footer.ends_with(kLastId)) {
    out += footer;
    return;
  }
  append_footer(footer.substr(0, kFooterId.size()),
                little_endian(footer.substr(footer.size() - tail, 4)), out);
}

class FbxNodeWriter {
 public:
  explicit FbxNodeWriter(int version) : number_size_(version < kFbxWideVersion ? 4 : 8) {}

  size_t empty_node() const { return 3 * number_size_ + 1; }
  void append_number(uint64_t number, std::string& out) const {
    append_little_endian(number, number_size_, out);
  }
  void set_end(size_t begin, std::string& out) const {
    for (size_t i = 0; i < number_size_; ++i) {
      out[begin + i] = static_cast<char>(uint64_t{out.size()} >> (8 * i) & 0xff);
    }
  }
  void append(const FbxNewNode& node, std::string& out) const {
    const size_t begin = out.size();
    std::string values;
    for (const FbxNewValue& value : node.values) value.append_binary(values);
    append_number(0, out);
    append_number(node.values.size(), out);
    append_number(values.size(), out);
    assert(node.name.size() < 256);
    out += static_cast<char>(node.name.size());
    out += node.name;
    out += values;
    for (const FbxNewNode& child : node.children) append(child, out);
    if (!node.children.empty() || node.has_list) out.append(empty_node(), '\0');
    set_end(begin, out);
  }

 private:
  size_t number_size_;
};

void append_text(const FbxNewNode& node, size_t depth, std::string& out) {
  out.append(depth, '\t') += node.name + ": ";
  for (size_t i = 0; i < node.values.size(); ++i) {
    if (i > 0) out += ", ";
    node.values[i].append_text(out);
  }
  const bool is_array = node.values.size() == 1 && node.values[0].is_array();
  if (is_array) {
    out += " {\n";
    out.append(depth + 1, '\t') += "a: ";
    node.values[0].append_numbers(out);
    (out += '\n').append(depth, '\t') += "}";
  } else if (!node.children.empty() || node.has_list) {
    out += " {\n";
    for (const FbxNewNode& child : node.children) append_text(child, depth + 1, out);
    out.append(depth, '\t') += "}";
  }
  out += '\n';
}

}  // namespace

const std::string kFbxFileId("\x28\xb3\x2a\xeb\xb6\x24\xcc\xc2\xbf\xc8\xb0\x2a\xa9\x2b\xfc\xf1",
                             16);

namespace {

template <class T>
std::string binary_array(std::span<const T> numbers) {
  std::string out;
  append_little_endian(numbers.size(), 4, out);
  append_little_endian(0, 4, out);  // Not compressed.
  append_little_endian(numbers.size() * sizeof(T), 4, out);
  for (const T number : numbers) append_little_endian(bits_of(number), sizeof(T), out);
  return out;
}

template <class T>
std::string text_array(std::span<const T> numbers) {
  std::string out;
  for (const T number : numbers) out += (out.empty() ? "" : ",") + exact(number);
  return out;
}

template <class T>
std::string binary_number(T number) {
  std::string out;
  append_little_endian(bits_of(number), sizeof(T), out);
  return out;
}

}  // namespace

FbxNewValue FbxNewValue::whole(int64_t number) {
  FbxNewValue out;
  out.type_ = 'L', out.binary_ = binary_number(number), out.text_ = exact(number);
  return out;
}
FbxNewValue FbxNewValue::small(int32_t number) {
  FbxNewValue out;
  out.type_ = 'I', out.binary_ = binary_number(number), out.text_ = exact(number);
  return out;
}
FbxNewValue FbxNewValue::number(double number) {
  FbxNewValue out;
  out.type_ = 'D', out.binary_ = binary_number(number), out.text_ = exact(number);
  return out;
}
FbxNewValue FbxNewValue::string(std::string text) {
  FbxNewValue out;
  out.type_ = 'S';
  out.text_ = text;
  for (char& c : out.text_) {
    if (c == '"' || c == '\0') c = '_';
  }
  out.text_ = "\"" + out.text_ + "\"";
  if (const size_t colons = text.find("::"); colons != text.npos) {
    text = text.substr(colons + 2) + std::string("\0\x01", 2) + text.substr(0, colons);
  }
  append_little_endian(text.size(), 4, out.binary_);
  out.binary_ += text;
  return out;
}
FbxNewValue FbxNewValue::bytes(std::string bytes) {
  FbxNewValue out;
  out.type_ = 'R';
  append_little_endian(bytes.size(), 4, out.binary_);
  out.binary_ += bytes;
  out.text_ = "\"\"";
  return out;
}
template <class T>
FbxNewValue FbxNewValue::array(char type, std::span<const T> numbers) {
  FbxNewValue out;
  out.type_ = type, out.count_ = numbers.size();
  out.binary_ = binary_array(numbers), out.text_ = text_array(numbers);
  return out;
}
FbxNewValue FbxNewValue::times(std::span<const int64_t> numbers) { return array('l', numbers); }
FbxNewValue FbxNewValue::wholes(std::span<const int32_t> numbers) { return array('i', numbers); }
FbxNewValue FbxNewValue::floats(std::span<const float> numbers) { return array('f', numbers); }
FbxNewValue FbxNewValue::doubles(std::span<const double> numbers) { return array('d', numbers); }

FbxNewValue FbxNewValue::copy(const FbxValue& value) {
  FbxNewValue out;
  out.type_ = value.type;
  if (value.type == 'S' || value.type == 'R') {
    append_little_endian(value.bytes.size(), 4, out.binary_);
  }
  out.binary_ += value.bytes;
  out.text_ = value.type == '"' ? "\"" + std::string(value.bytes) + "\"" : std::string(value.bytes);
  return out;
}

void FbxNewValue::append_binary(std::string& out) const {
  out += type_;
  out += binary_;
}

void FbxNewValue::append_text(std::string& out) const {
  out += is_array() ? "*" + std::to_string(count_) : text_;
}

void FbxNewValue::append_numbers(std::string& out) const { out += text_; }

FbxNewNode& FbxNewNode::add(std::string child, std::vector<FbxNewValue> child_values) {
  has_list = true;
  return children.emplace_back(FbxNewNode{std::move(child), std::move(child_values), {}, false});
}

FbxNewNode* FbxNewNode::child(std::string_view wanted) {
  const auto found = std::find_if(children.begin(), children.end(),
                                  [&](const FbxNewNode& node) { return node.name == wanted; });
  return found == children.end() ? nullptr : &*found;
}

void FbxNewNode::set(const std::string& name_of, std::vector<FbxNewValue> child_values) {
  FbxNewNode* found = child(name_of);
  if (!found) {
    add(name_of, std::move(child_values));
  } else {
    *found = {name_of, std::move(child_values), {}, false};
  }
}

FbxNewNode copy_fbx_node(const FbxNode& node) {
  FbxNewNode out{std::string(node.name), {}, {}, node.has_list};
  for (const FbxValue& value : node.values) out.values.push_back(FbxNewValue::copy(value));
  for (const FbxNode& child : node.children) out.children.push_back(copy_fbx_node(child));
  return out;
}

namespace {

// Rebuilds a binary file node by node, because each header states where the node ends.
class FbxBinaryEditor {
 public:
  FbxBinaryEditor(const FbxTree& tree, const FbxEdits& edits)
      : tree_(tree), edits_(edits), writer_(tree.version()) {}

  std::string edit() {
    const FbxNode& root = tree_.root();
    out_ = tree_.bytes().substr(0, root.begin);
    append_list(root);
    // The empty node and what is behind it.
    const std::string_view rest = std::string_view(tree_.bytes()).substr(root.list_end);
    const size_t empty = std::min(rest.size(), writer_.empty_node());
    out_ += rest.substr(0, empty);
    append_moved_footer(rest.substr(empty), out_);
    return std::move(out_);
  }

 private:
  void append_list(const FbxNode& parent) {
    for (const FbxNode& node : parent.children) append(node);
    append_new(edits_.added(), parent);
  }
  void append_new(const FbxEdits::Nodes& of, const FbxNode& node) {
    const auto found = of.find(&node);
    if (found == of.end()) return;
    for (const FbxNewNode& added : found->second) writer_.append(added, out_);
  }

  void append(const FbxNode& node) {
    append_new(edits_.before(), node);
    if (edits_.replaced().contains(&node)) return append_new(edits_.replaced(), node);
    const size_t begin = out_.size();
    const std::string_view bytes = tree_.bytes();
    const size_t first = node.children.empty() ? node.has_list ? node.list_end : node.end
                                               : node.children.front().begin;
    out_ += bytes.substr(node.begin, first - node.begin);
    if (node.has_list) {
      append_list(node);
      out_ += bytes.substr(node.list_end, node.end - node.list_end);
    }
    writer_.set_end(begin, out_);
  }

  const FbxTree& tree_;
  const FbxEdits& edits_;
  FbxNodeWriter writer_;
  std::string out_;
};

// Splices new text into the old.
class FbxTextEditor {
 public:
  FbxTextEditor(const FbxTree& tree, const FbxEdits& edits) : tree_(tree), edits_(edits) {}

  std::string edit() {
    splice_list(tree_.root(), 0);
    out_ += std::string_view(tree_.bytes()).substr(at_);
    return std::move(out_);
  }

 private:
  void copy_to(size_t end) {
    out_ += std::string_view(tree_.bytes()).substr(at_, end - at_);
    at_ = end;
  }
  // The beginning of the line of `position` if only blanks are before it.
  size_t line_begin(size_t position) const {
    size_t begin = position;
    const std::string& text = tree_.bytes();
    while (begin > at_ && (text[begin - 1] == ' ' || text[begin - 1] == '\t')) --begin;
    return begin == 0 || text[begin - 1] == '\n' ? begin : position;
  }
  void append_new(const std::vector<FbxNewNode>& nodes, size_t depth) {
    if (!nodes.empty() && !out_.empty() && out_.back() != '\n') out_ += '\n';
    for (const FbxNewNode& node : nodes) append_text(node, depth, out_);
  }

  void splice_list(const FbxNode& parent, size_t depth) {
    for (const FbxNode& node : parent.children) {
      if (const auto before = edits_.before().find(&node); before != edits_.before().end()) {
        copy_to(line_begin(node.begin));
        append_new(before->second, depth);
      }
      if (const auto replaced = edits_.replaced().find(&node);
          replaced != edits_.replaced().end()) {
        copy_to(line_begin(node.begin));
        append_new(replaced->second, depth);
        at_ = node.end;
        // The new node has a line end of its own.
        const std::string& text = tree_.bytes();
        if (at_ < text.size() && text[at_] == '\r') ++at_;
        if (at_ < text.size() && text[at_] == '\n') ++at_;
      } else if (node.has_list) {
        splice_list(node, depth + 1);
      }
    }
    if (const auto added = edits_.added().find(&parent); added != edits_.added().end()) {
      copy_to(line_begin(parent.list_end));
      append_new(added->second, depth);
    }
  }

  const FbxTree& tree_;
  const FbxEdits& edits_;
  size_t at_ = 0;
  std::string out_;
};

}  // namespace

std::string FbxEdits::apply(const FbxTree& tree) const {
  if (empty()) return tree.bytes();
  return tree.is_binary() ? FbxBinaryEditor(tree, *this).edit() : FbxTextEditor(tree, *this).edit();
}

std::string format_fbx_file(const std::vector<FbxNewNode>& sections) {
  std::string out(kNewStart);
  append_little_endian(kNewVersion, 4, out);
  const FbxNodeWriter writer(kNewVersion);
  for (const FbxNewNode& section : sections) writer.append(section, out);
  out.append(writer.empty_node(), '\0');
  append_footer(kFooterId, kNewVersion, out);
  return out;
}

}  // namespace panache
