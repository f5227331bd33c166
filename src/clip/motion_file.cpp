#include "clip/motion_file.h"

#include <filesystem>
#include <utility>

#include "base/file.h"
#include "clip/bvh.h"
#include "clip/gltf.h"

namespace panache {
namespace {

// Takes the bytes of a file and its name for sentences.
using Parser = Result<std::unique_ptr<MotionFile>> (*)(std::string, const std::string&);

struct Format {
  const char* ending;  // Lower case, with the point.
  Parser parse;
};
constexpr Format kFormats[] = {
    {".bvh", parse_bvh}, {".glb", parse_gltf}, {".gltf", parse_gltf}, {".vrm", parse_gltf}};

std::string lower_case(std::string text) {
  for (char& c : text) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return text;
}

std::string all_endings() {
  std::string list;
  for (const Format& format : kFormats) {
    if (!list.empty()) list += ", ";
    list += format.ending;
  }
  return list;
}

}  // namespace

Result<std::unique_ptr<MotionFile>> read_motion(const std::string& path) {
  const std::string ending = std::filesystem::path(path).extension().string();
  for (const Format& format : kFormats) {
    if (lower_case(ending) != format.ending) continue;
    auto bytes = read_file(path);
    if (!bytes) return bytes.error();
    return format.parse(std::move(*bytes), path);
  }
  return Error{path + ": expected a motion file (" + all_endings() + "), found " +
               (ending.empty() ? "no ending" : "the ending '" + ending + "'")};
}

}  // namespace panache
