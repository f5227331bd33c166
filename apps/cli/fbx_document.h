#pragma once
// FBX text as a tree, for the files that Assimp does not read.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"

namespace panache::cli {

// `Name: value, value { children }`. All strings point into the document's text.
struct FbxNode {
  std::string_view name;
  std::vector<std::string_view> values;  // Without quotes.
  std::vector<FbxNode> children;

  // The first child with this name, or null.
  const FbxNode* child(std::string_view wanted) const;
  // "" if there are fewer values.
  std::string_view value(size_t index) const;
};

class FbxDocument {
 public:
  // `text` must outlive the document; messages begin with `name`. Rejects names without a colon,
  // unterminated strings, unbalanced braces and more than 64 levels of nesting; the message gives
  // the line and column.
  static Result<FbxDocument> parse(std::string_view text, const std::string& name);

  // Its children are the file's sections.
  const FbxNode& root() const { return root_; }
  // The nodes in all sections with this name.
  std::vector<const FbxNode*> in_sections(std::string_view wanted) const;
  const std::string& name() const { return name_; }

  // The version, such as 6100; 0 if the file does not state it.
  int version() const;

  // "NAME:LINE:COLUMN: expected EXPECTED, found FOUND": `found` is part of the document's text.
  Error error(std::string_view found, const std::string& expected) const;

  // Reads a number, at most kLargestNumber (decimal.h); `of_what` names it in messages.
  Result<double> number(std::string_view text, const std::string& of_what) const;
  // Reads a time in FBX units of 1/46186158000 s.
  Result<int64_t> time(std::string_view text) const;

 private:
  FbxDocument(std::string_view text, std::string name) : text_(text), name_(std::move(name)) {}

  std::string_view text_;
  std::string name_;
  FbxNode root_;
};

// The version of a binary FBX file, such as 6100; 0 if the file does not begin as binary FBX.
int binary_fbx_version(std::string_view bytes);

// Converts a binary file of a version below 7000 to text; later versions, with compressed arrays,
// are left to Assimp. Checks every length against the remaining bytes; messages begin with `path`.
Result<std::string> fbx_text_of(std::string_view bytes, const std::string& path);

}  // namespace panache::cli
