#pragma once
// The JSON of a glTF file, taken apart with every type and index checked. For the readers in this
// folder and for the program's.

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "base/result.h"

namespace panache {

// Members keep their order, so that a file comes back as its author wrote it.
using GltfJson = nlohmann::ordered_json;

// Limits of a file's JSON, so that no file can exhaust the stack or the patience of those
// who write it back: writing recurses, and finding a member takes as long as there are members.
inline constexpr int kGltfMaxJsonDepth = 200;
inline constexpr int kGltfMaxJsonMembers = 1'000;  // Of one object.

// Reads members and remembers the first thing that is wrong. Functions that check return whether
// all is well; `path` is where in the JSON an object stands ("animations[1]"), and names are said
// after it. What is absent leaves `out` alone.
class GltfChecker {
 public:
  // `name` stands in front of every message.
  explicit GltfChecker(std::string name) : name_(std::move(name)) {}

  // Keeps "NAME: PATH: SENTENCE" if it is the first failure; an empty path is left out.
  bool fail(const std::string& path, const std::string& message);
  bool failed() const { return !message_.empty(); }
  Error error() const { return Error{message_}; }

  // The whole text, which `out` then holds; an object.
  bool parse(std::string_view text, GltfJson& out);

  // The member `key` of `object` if it is there; it has to be a list. An empty one where it is
  // absent.
  bool list(const GltfJson& object, const std::string& path, const char* key, const GltfJson*& out);
  // The same for an object; null where it is absent.
  bool object(const GltfJson& object, const std::string& path, const char* key,
              const GltfJson*& out);
  bool text(const GltfJson& object, const std::string& path, const char* key, std::string& out);
  bool flag(const GltfJson& object, const std::string& path, const char* key, bool& out);
  // A whole number from 0 on.
  bool count(const GltfJson& object, const std::string& path, const char* key, uint64_t& out);
  // A place in a list of `size` things; -1 where it is absent.
  bool index(const GltfJson& object, const std::string& path, const char* key, size_t size,
             int& out);
  // Exactly out.size() numbers within kLargestNumber.
  bool numbers(const GltfJson& object, const std::string& path, const char* key,
               std::span<double> out);
  // Whether `value`, which stands at `path`, is a place in a list of `size` things.
  bool index_value(const GltfJson& value, const std::string& path, size_t size, int& out);
  // Whether `value` is a JSON object.
  bool is_object(const GltfJson& value, const std::string& path);

 private:
  std::string name_;
  std::string message_;
};

// "PATH.KEY", or the key alone where the path is empty.
std::string member_path(const std::string& path, const std::string& key);
// "PATH[INDEX]".
std::string item_path(const std::string& path, size_t index);

}  // namespace panache
