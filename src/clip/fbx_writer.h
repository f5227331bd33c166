#pragma once
// Writes FBX files: new ones, and files as they were read with some nodes changed. Private to the
// folder.

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "clip/fbx_tree.h"

namespace panache {

// A value to be written. A string such as "Model::Hips" becomes "Hips\0\1Model" in binary files.
class FbxNewValue {
 public:
  static FbxNewValue whole(int64_t number);                     // 'L'
  static FbxNewValue small(int32_t number);                     // 'I'
  static FbxNewValue number(double number);                     // 'D'
  static FbxNewValue string(std::string text);                  // 'S'
  static FbxNewValue bytes(std::string bytes);                  // 'R'
  static FbxNewValue times(std::span<const int64_t> numbers);   // 'l'
  static FbxNewValue wholes(std::span<const int32_t> numbers);  // 'i'
  static FbxNewValue floats(std::span<const float> numbers);    // 'f'
  static FbxNewValue doubles(std::span<const double> numbers);  // 'd'
  // As the tree has it, bit for bit; for files of the same form.
  static FbxNewValue copy(const FbxValue& value);

  bool is_array() const { return count_ != kNoArray; }
  void append_binary(std::string& out) const;
  // An array is its length; the numbers come from append_numbers().
  void append_text(std::string& out) const;
  void append_numbers(std::string& out) const;

 private:
  template <class T>
  static FbxNewValue array(char type, std::span<const T> numbers);

  static constexpr size_t kNoArray = ~size_t{0};
  char type_ = 'I';
  std::string binary_;  // Without the type.
  std::string text_;    // Of an array: its numbers.
  size_t count_ = kNoArray;
};

struct FbxNewNode {
  std::string name;
  std::vector<FbxNewValue> values;
  std::vector<FbxNewNode> children;
  bool has_list = false;  // Writes a list of children even if it is empty.

  FbxNewNode& add(std::string child, std::vector<FbxNewValue> child_values = {});
  // Replaces the first child of this name, or adds one.
  void set(const std::string& child, std::vector<FbxNewValue> child_values);
  FbxNewNode* child(std::string_view wanted);
};
FbxNewNode copy_fbx_node(const FbxNode& node);

// Changes to a tree; its nodes are those of one tree.
class FbxEdits {
 public:
  bool empty() const { return replaced_.empty() && before_.empty() && added_.empty(); }
  // Each node at most once.
  void replace(const FbxNode& node, FbxNewNode by) { replaced_[&node] = {std::move(by)}; }
  void drop(const FbxNode& node) { replaced_[&node] = {}; }
  bool is_replaced(const FbxNode& node) const { return replaced_.contains(&node); }
  void add_before(const FbxNode& node, FbxNewNode added) {
    before_[&node].push_back(std::move(added));
  }
  // At the end of its list, which it must have.
  void add_to(const FbxNode& node, FbxNewNode added) { added_[&node].push_back(std::move(added)); }

  // The file with the changes. All other nodes keep their bytes; in a binary file, except for the
  // positions in it that their headers state.
  std::string apply(const FbxTree& tree) const;

  // What stands in the place of a node, before it, and at the end of its list.
  using Nodes = std::map<const FbxNode*, std::vector<FbxNewNode>>;
  const Nodes& replaced() const { return replaced_; }
  const Nodes& before() const { return before_; }
  const Nodes& added() const { return added_; }

 private:
  Nodes replaced_, before_, added_;
};

// A new binary file of version 7.4 with these sections.
std::string format_fbx_file(const std::vector<FbxNewNode>& sections);

// What identifies files by their time of creation, as programs check.
inline constexpr const char* kFbxCreationTime = "1970-01-01 10:00:00:000";
extern const std::string kFbxFileId;

}  // namespace panache
