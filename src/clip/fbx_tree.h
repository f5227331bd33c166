#pragma once
// An FBX file, binary or text, as a tree of nodes that knows where each is in the file. Private to
// the folder.

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"

namespace panache {

// A value as the file has it. Types of binary files: C Y I L F D numbers, S R strings, b i l f d
// arrays (`bytes` then begins with count, encoding and size). Types of text files: '"' a string
// without its quotes, 'w' a word.
struct FbxValue {
  char type = 'w';
  std::string_view bytes;
};

// `Name: value, value { children }`.
struct FbxNode {
  std::string_view name;
  std::vector<FbxValue> values;
  std::vector<FbxNode> children;
  bool has_list = false;  // Has a list of children, perhaps an empty one.
  size_t begin = 0;       // Where in the file it begins,
  size_t list_end = 0;    // where its list of children ends: at '}' or at the empty node,
  size_t end = 0;         // and the byte behind it.

  // The first child with this name, or null.
  const FbxNode* child(std::string_view wanted) const;
};

class FbxTree {
 public:
  // Rejects what is not FBX, is damaged, or has more than 64 levels; messages begin with `name`,
  // and with line and column of a text file.
  static Result<FbxTree> parse(std::string bytes, std::string name);

  // All views point into the bytes, so a tree is moved but not copied.
  FbxTree(FbxTree&&) = default;
  FbxTree& operator=(FbxTree&&) = default;

  const std::string& bytes() const { return *bytes_; }
  const std::string& name() const { return name_; }
  bool is_binary() const { return is_binary_; }
  int version() const { return version_; }  // Such as 7400; 0 if the file does not state it.
  // Its children are the file's sections; its list ends behind them.
  const FbxNode& root() const { return root_; }
  // The nodes in all sections with this name.
  std::vector<const FbxNode*> in_sections(std::string_view wanted) const;

  // The value `which` of a node as text: "Model::Hips" also where a binary file has
  // "Hips\0\1Model".
  // "" if there are fewer values.
  std::string text(const FbxNode& node, size_t which) const;
  // False if there is no such value, or none of this kind; numbers are within kLargestNumber.
  bool integer(const FbxNode& node, size_t which, int64_t& out) const;
  bool number(const FbxNode& node, size_t which, double& out) const;

  // The values of an array (`Name: *3 { a: 1,2,3 }` in text, or as old files have it `Name:
  // 1,2,3`). False if it is damaged, or has numbers beyond kLargestNumber; empty if `node` is null.
  bool integers(const FbxNode* node, std::vector<int64_t>& out) const;
  bool numbers(const FbxNode* node, std::vector<double>& out) const;
  // Of any size, and NaN.
  bool raw_floats(const FbxNode* node, std::vector<float>& out) const;

  // "WHERE: expected EXPECTED, found FOUND".
  Error error(const FbxNode& at, const std::string& expected, const std::string& found) const;
  // With what the node says as what was found.
  Error error(const FbxNode& at, size_t which, const std::string& expected) const;

 private:
  FbxTree(std::string bytes, std::string name)
      : bytes_(std::make_unique<std::string>(std::move(bytes))), name_(std::move(name)) {}

  template <class T>
  bool array(const FbxNode* node, std::vector<T>& out) const;

  std::unique_ptr<std::string> bytes_;
  std::string name_;
  bool is_binary_ = false;
  int version_ = 0;
  FbxNode root_;
};

inline constexpr int kFbxMaxDepth = 64;             // Real files have about ten levels.
inline constexpr size_t kFbxMaxNodes = 20'000'000;  // In a file.
inline constexpr size_t kFbxArrayHeader = 12;       // Count, encoding, size.
inline constexpr int kFbxWideVersion = 7500;        // From here on, binary headers have 64 bits.
inline constexpr const char* kFbxNoWord = " \t\r\n\v\f,:;{}\"";  // Characters that end a word.

// fbx_parse.cpp: fill the root of a tree.
Result<void> parse_fbx_binary(std::string_view bytes, const std::string& name, FbxNode& root);
Result<void> parse_fbx_text(std::string_view text, const std::string& name, FbxNode& root);

// "NAME:LINE:COLUMN" of a position in a text.
std::string fbx_position(std::string_view text, size_t offset, const std::string& name);

// The version of a binary FBX file; 0 if the file does not begin as one.
int binary_fbx_version(std::string_view bytes);

}  // namespace panache
