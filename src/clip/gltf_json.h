#pragma once
// The JSON of a glTF file, with every type and index checked on reading, and the addresses of
// data in it: data URIs and relative files (gltf_uri.cpp). For the readers in this folder and in
// the program.

#include <cstdint>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/result.h"

namespace panache {

// Members keep their order, so that a file is written as its author wrote it.
using GltfJson = nlohmann::ordered_json;

// Limits that keep a file's JSON from exhausting the stack or taking too long to write: writing
// recurses, and finding a member takes linear time.
inline constexpr size_t kGltfMaxJsonDepth = 200;
inline constexpr int kGltfMaxJsonMembers = 1'000;  // In one object.

// Remembers the first error in a file.
class GltfChecker {
 public:
  // Messages start with `name`.
  explicit GltfChecker(std::string name) : name_(std::move(name)) {}

  // Keeps "NAME: PATH: MESSAGE" if it is the first failure; an empty path is omitted. Returns
  // false.
  bool fail(const std::string& path, const std::string& message);
  bool ok() const { return message_.empty(); }
  Error error() const { return Error{message_}; }

  // Parses the whole text into `out`; it must be an object.
  bool parse(std::string_view text, GltfJson& out);

 private:
  std::string name_;
  std::string message_;
};

// A value of the JSON and its path ("animations[1].channels[0]"), or nothing. A missing member
// reads as nothing; so does one of the wrong kind, which the checker remembers.
class GltfPart {
 public:
  // The root of a file. Both outlive the part and those that are made from it.
  GltfPart(const GltfJson& json, GltfChecker& checker) : GltfPart(&json, checker, "") {}

  explicit operator bool() const { return json_ != nullptr; }
  const GltfJson& json() const { return *json_; }
  const std::string& path() const { return path_; }
  bool fail(const std::string& message) const { return checker_->fail(path_, message); }
  bool ok() const { return checker_->ok(); }

  // A member of any type.
  GltfPart member(const std::string& key) const;
  GltfPart object(const std::string& key) const;
  // All members with their names; long names are shortened in paths.
  std::vector<std::pair<std::string, GltfPart>> members() const;
  std::vector<GltfPart> list(const std::string& key) const;
  size_t size(const std::string& key) const;                  // Of a list.
  GltfPart item(const std::string& key, size_t index) const;  // In a list that has it.
  std::string text(const std::string& key, const std::string& otherwise = "") const;
  bool flag(const std::string& key) const;
  // A non-negative integer.
  uint64_t count(const std::string& key, uint64_t otherwise = 0) const;
  // The index in a list of `size` things that a member, or the value itself, holds; -1 for none.
  int index(const std::string& key, size_t size) const;
  int as_index(size_t size) const;
  // Exactly out.size() numbers within kLargestNumber; a missing member leaves `out` unchanged.
  void numbers(const std::string& key, std::span<double> out) const;

 private:
  GltfPart(const GltfJson* json, GltfChecker& checker, std::string path)
      : json_(json), checker_(&checker), path_(std::move(path)) {}
  GltfPart member(const std::string& key, bool (GltfJson::*is)() const noexcept,
                  const std::string& kind) const;
  // Remembers that something else was expected here; returns nothing.
  GltfPart wrong(const std::string& expected) const;

  const GltfJson* json_;
  GltfChecker* checker_;
  std::string path_;
};

// "PATH.KEY", or just the key if the path is empty.
std::string member_path(const std::string& path, const std::string& key);
// "PATH[INDEX]".
std::string item_path(const std::string& path, size_t index);

bool is_data_uri(std::string_view uri);
// Decodes a data URI; error messages have no name in front.
Result<std::string> decode_data_uri(std::string_view uri);
// "data:TYPE;base64,...".
std::string make_data_uri(std::string_view type, std::string_view bytes);

// The path of the file that the relative `uri` refers to from a file at `path`. References outside
// that file's folder are rejected, with a message without a name.
Result<std::string> resolve_uri(std::string_view uri, const std::string& path);

}  // namespace panache
