#pragma once
// FBX in text form as a tree: what Assimp does not read of it is read from here.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"

namespace panache::cli {

// `Name: value, value { children }`. All text is that of the document.
struct FbxNode {
  std::string_view name;
  std::vector<std::string_view> values;  // Without their quotes.
  std::vector<FbxNode> children;

  // The first child of this name, or null.
  const FbxNode* child(std::string_view wanted) const;
  // "" where there are fewer values.
  std::string_view value(size_t index) const;
};

class FbxDocument {
 public:
  // `text` outlives the document; `name` stands in front of its messages. Rejected are names
  // without a colon, strings without an end, braces without another, and more than 64 levels of
  // them; the message says the line and column.
  static Result<FbxDocument> parse(std::string_view text, const std::string& name);

  // Its children are the sections of the file.
  const FbxNode& root() const { return root_; }
  // What is in all sections of a name.
  std::vector<const FbxNode*> in_sections(std::string_view wanted) const;
  const std::string& name() const { return name_; }

  // The version, as in 6100; 0 where the file does not say it.
  int version() const;

  // "NAME:LINE:COLUMN: expected EXPECTED, found FOUND": `found` is part of the document's text.
  Error error(std::string_view found, const std::string& expected) const;

  // Reads a number of the document, at most kLargestNumber (decimal.h); `of_what` is for the
  // message.
  Result<double> number(std::string_view text, const std::string& of_what) const;
  // The same for a time in the unit of FBX, 1/46186158000 s.
  Result<int64_t> time(std::string_view text) const;

 private:
  FbxDocument(std::string_view text, std::string name) : text_(text), name_(std::move(name)) {}

  std::string_view text_;
  std::string name_;
  FbxNode root_;
};

// Whether a file begins as binary FBX does; its version, as in 6100, or 0 where it does not.
int binary_fbx_version(std::string_view bytes);

// The text form of a binary file of a version below 7000: later ones, which compress their arrays,
// are Assimp's. Every length is checked against the bytes there are; `path` stands in front of the
// messages.
Result<std::string> fbx_text_of(std::string_view bytes, const std::string& path);

}  // namespace panache::cli
