#pragma once
// The binary form of FBX files, made from their text form as the format has it: a node is where it
// ends, how many values it has, their bytes, its name, the values, and its children with an empty
// node behind them.

#include <bit>
#include <charconv>
#include <cstring>
#include <string>
#include <string_view>

#include <gtest/gtest.h>

#include "clip/fbx_tree.h"

namespace panache::test {

class BinaryFbxWriter {
 public:
  // `is_packed`: arrays are zlib streams (of stored blocks).
  BinaryFbxWriter(int version, bool is_packed) : version_(version), is_packed_(is_packed) {}

  std::string write(const std::string& text) {
    const Result<FbxTree> tree = FbxTree::parse(text, "text");
    EXPECT_TRUE(tree.ok());
    if (!tree) return "";
    out_ = std::string("Kaydara FBX Binary  \0\x1a\0", 23);
    put(int32_t{version_});
    for (const FbxNode& node : tree->root().children) add(node);
    add_picture();
    out_.append(empty_node(), '\0');
    return std::move(out_) + "What stands behind the nodes is not read.";
  }

 private:
  size_t number_size() const { return version_ < 7500 ? 4 : 8; }
  size_t empty_node() const { return 3 * number_size() + 1; }

  template <class T>
  void put(T number) {
    out_.append(reinterpret_cast<const char*>(&number), sizeof number);
  }
  void put_number(uint64_t number) {
    out_.append(reinterpret_cast<const char*>(&number), number_size());
  }
  void put_at(size_t offset, uint64_t number) {
    std::memcpy(out_.data() + offset, &number, number_size());
  }
  void put_end(size_t node) { put_at(node, out_.size()); }

  size_t begin(std::string_view name, size_t values) {
    const size_t node = out_.size();
    put_number(0);
    put_number(values);
    put_number(0);
    put(static_cast<uint8_t>(name.size()));
    out_.append(name);
    return node;
  }
  void put_values_size(size_t node, size_t size) { put_at(node + 2 * number_size(), size); }

  void add(const FbxNode& from) {
    const size_t node = begin(from.name, from.values.size()), values = out_.size();
    const bool is_array = from.values.size() == 1 && from.values[0].bytes.starts_with('*');
    if (is_array) {
      add_array(from);
    } else {
      for (const FbxValue& value : from.values) add_value(value);
    }
    put_values_size(node, out_.size() - values);
    if (from.has_list && !is_array) {
      for (const FbxNode& child : from.children) add(child);
      out_.append(empty_node(), '\0');
    }
    put_end(node);
  }

  template <class T>
  static std::string array_of(const FbxNode& from) {
    std::string out;
    for (const FbxValue& value : from.child("a")->values) {
      T number = 0;
      const char* const end = value.bytes.data() + value.bytes.size();
      EXPECT_EQ(std::from_chars(value.bytes.data(), end, number).ptr, end) << value.bytes;
      out.append(reinterpret_cast<const char*>(&number), sizeof number);
    }
    return out;
  }

  void add_array(const FbxNode& from) {
    const std::string_view name = from.name;
    // Text files have the bits of the attributes' floats.
    const char type = name == "KeyTime"                                    ? 'l'
                      : name == "KeyValueFloat"                            ? 'f'
                      : name == "KeyAttrDataFloat"                         ? 'F'
                      : name.starts_with("Key") || name.ends_with("Index") ? 'i'
                                                                           : 'd';
    const std::string data = type == 'l'                  ? array_of<int64_t>(from)
                             : type == 'f'                ? array_of<float>(from)
                             : type == 'F' || type == 'i' ? array_of<int32_t>(from)
                                                          : array_of<double>(from);
    const std::string packed = is_packed_ ? packed_of(data) : data;
    out_ += type == 'F' ? 'f' : type;
    put(static_cast<uint32_t>(from.child("a")->values.size()));
    put(uint32_t{is_packed_});
    put(static_cast<uint32_t>(packed.size()));
    out_ += packed;
  }

  static std::string packed_of(std::string_view data) {
    std::string out = "\x78\x01";
    uint32_t a = 1, b = 0;
    for (const char c : data) {
      a = (a + static_cast<unsigned char>(c)) % 65521;
      b = (b + a) % 65521;
    }
    do {
      const auto size = static_cast<uint16_t>(std::min<size_t>(data.size(), 60'000));
      out += data.size() == size ? '\1' : '\0';
      for (const uint16_t number : {size, static_cast<uint16_t>(~size)}) {
        out += static_cast<char>(number & 255);
        out += static_cast<char>(number >> 8);
      }
      out += data.substr(0, size);
      data.remove_prefix(size);
    } while (!data.empty());
    for (const uint32_t half : {b, a}) {
      out += static_cast<char>(half >> 8);
      out += static_cast<char>(half & 255);
    }
    return out;
  }

  void add_picture() {
    const size_t node = begin("Content", 1);
    out_ += "R";
    put(uint32_t{3});
    out_ += "\"{\xff";
    put_values_size(node, 8);
    put_end(node);
  }

  // Whole numbers in the smallest type that they fit into, others in the smaller type if they fit.
  // IDs have the largest.
  void add_value(const FbxValue& from) {
    const std::string_view value = from.bytes;
    const char* const end = value.data() + value.size();
    int64_t whole = 0;
    double number = 0;
    if (from.type == '"') {
      add_string(value);
    } else if (std::from_chars(value.data(), end, whole).ptr == end) {
      if (version_ >= 7000 && whole >= 1000) {
        out_ += 'L';
        put(whole);
      } else if (whole == static_cast<int16_t>(whole)) {
        out_ += 'Y';
        put(static_cast<int16_t>(whole));
      } else if (whole == static_cast<int32_t>(whole)) {
        out_ += 'I';
        put(static_cast<int32_t>(whole));
      } else {
        out_ += 'L';
        put(whole);
      }
    } else if (std::from_chars(value.data(), end, number).ptr == end) {
      const auto small = static_cast<float>(number);
      if (static_cast<double>(small) == number) {
        out_ += 'F';
        put(small);
      } else {
        out_ += 'D';
        put(number);
      }
    } else {
      EXPECT_EQ(value.size(), 1u) << value;
      out_ += 'C';
      out_ += value[0];
    }
  }

  // "Model::Hips" is "Hips\0\1Model".
  void add_string(std::string_view value) {
    std::string text(value);
    const size_t colons = text.find("::");
    if (colons != text.npos) {
      text = text.substr(colons + 2) + std::string("\0\x01", 2) + text.substr(0, colons);
    }
    out_ += 'S';
    put(static_cast<uint32_t>(text.size()));
    out_ += text;
  }

  const int version_;
  const bool is_packed_;
  std::string out_;
};

inline std::string to_binary_fbx6(const std::string& text) {
  return BinaryFbxWriter(6100, false).write(text);
}
// Of version 7, with its IDs from 1000 on.
inline std::string to_binary_fbx7(const std::string& text, int version, bool is_packed) {
  return BinaryFbxWriter(version, is_packed).write(text);
}

}  // namespace panache::test
