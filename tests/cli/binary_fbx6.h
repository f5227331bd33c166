#pragma once
// The binary form of FBX 6.1 files, made from their text form as the format has it: a node is where
// it ends, how many values it has, their bytes, its name, the values, and its children with an
// empty node behind them.

#include <charconv>
#include <cstring>
#include <string>
#include <string_view>

#include <gtest/gtest.h>

#include "fbx_document.h"

namespace panache::test {

class BinaryFbx6Writer {
 public:
  std::string write(const std::string& text) {
    const Result<cli::FbxDocument> document = cli::FbxDocument::parse(text, "text");
    EXPECT_TRUE(document.ok());
    if (!document) return "";
    out_ = std::string("Kaydara FBX Binary  \0\x1a\0", 23);
    put(int32_t{6100});
    for (const cli::FbxNode& node : document->root().children) add(node);
    add_picture();
    out_.append(kEmptyNode, '\0');
    return std::move(out_) + "What stands behind the nodes is not read.";
  }

 private:
  static constexpr size_t kEmptyNode = 13;

  template <class T>
  void put(T number) {
    out_.append(reinterpret_cast<const char*>(&number), sizeof number);
  }
  template <class T>
  void put_at(size_t place, T number) {
    std::memcpy(out_.data() + place, &number, sizeof number);
  }
  void put_end(size_t node) { put_at(node, static_cast<uint32_t>(out_.size())); }

  size_t begin(std::string_view name, size_t values) {
    const size_t node = out_.size();
    put(uint32_t{0});
    put(static_cast<uint32_t>(values));
    put(uint32_t{0});
    put(static_cast<uint8_t>(name.size()));
    out_.append(name);
    return node;
  }

  void add(const cli::FbxNode& from) {
    const size_t node = begin(from.name, from.values.size()), values = out_.size();
    for (const std::string_view value : from.values) add_value(value);
    put_at(node + 8, static_cast<uint32_t>(out_.size() - values));
    if (!from.children.empty()) {
      for (const cli::FbxNode& child : from.children) add(child);
      out_.append(kEmptyNode, '\0');
    }
    put_end(node);
  }

  void add_picture() {
    const size_t node = begin("Content", 1);
    out_ += "R";
    put(uint32_t{3});
    out_ += "\"{\xff";
    put_at(node + 8, uint32_t{8});
    put_end(node);
  }

  // Whole numbers in the smallest type that they fit into, others in the smaller type if they fit.
  void add_value(std::string_view value) {
    const char* const end = value.data() + value.size();
    int64_t whole = 0;
    double number = 0;
    if (value.data()[-1] == '"') {
      add_string(value);
    } else if (std::from_chars(value.data(), end, whole).ptr == end) {
      if (whole == static_cast<int16_t>(whole)) {
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

  std::string out_;
};

inline std::string to_binary_fbx6(const std::string& text) {
  return BinaryFbx6Writer().write(text);
}

}  // namespace panache::test
