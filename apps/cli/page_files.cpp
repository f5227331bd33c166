#include "page_files.h"

#include <cstdio>
#include <filesystem>
#include <functional>
#include <system_error>
#include <utility>
#include <vector>

#include "base/file.h"

namespace panache::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kPacked = ".br";

const char* type_of(std::string_view path) {
  constexpr std::pair<std::string_view, const char*> kTypes[] = {
      {".html", "text/html; charset=utf-8"},
      {".js", "text/javascript; charset=utf-8"},
      {".css", "text/css; charset=utf-8"},
      {".txt", "text/plain; charset=utf-8"},
      {".wasm", "application/wasm"},
      {".svg", "image/svg+xml"},
      {".png", "image/png"},
  };
  for (const auto& [extension, type] : kTypes) {
    if (path.ends_with(extension)) return type;
  }
  return "application/octet-stream";
}

std::string tag_of(std::string_view bytes) {
  char tag[24];
  std::snprintf(tag, sizeof tag, "\"%016zx\"", std::hash<std::string_view>{}(bytes));
  return tag;
}

// The paths of all files in a folder, relative to it, with a slash before: "/assets/main.js".
Result<std::vector<std::string>> list_files(const std::string& folder) {
  std::vector<std::string> paths;
  std::error_code status;
  for (fs::recursive_directory_iterator entry(folder, status), end; entry != end;
       entry.increment(status)) {
    if (status) break;
    if (entry->is_regular_file(status)) {
      paths.push_back("/" + entry->path().lexically_relative(folder).generic_string());
    }
  }
  if (status)
    return Error{folder + ": this folder of the page cannot be read: " + status.message()};
  return paths;
}

}  // namespace

Result<PageFiles> PageFiles::read(const std::string& folder) {
  const Result<std::vector<std::string>> paths = list_files(folder);
  if (!paths) return paths.error();
  PageFiles out;
  for (const std::string& path : *paths) {
    Result<std::string> bytes = read_file(folder + path);
    if (!bytes) return bytes.error();
    const bool packed = path.ends_with(kPacked);
    PageFile& file = out.files_[packed ? path.substr(0, path.size() - kPacked.size()) : path];
    (packed ? file.packed_tag : file.bytes_tag) = tag_of(*bytes);
    (packed ? file.packed : file.bytes) = *std::move(bytes);
  }
  // A packed file without its original is of no use to browsers that do not ask for one.
  std::erase_if(out.files_, [](const auto& entry) { return entry.second.bytes_tag.empty(); });
  for (auto& [path, file] : out.files_) file.type = type_of(path);
  return out;
}

const PageFile* PageFiles::find(std::string_view path) const {
  const auto found = files_.find(path == "/" ? "/index.html" : path);
  return found == files_.end() ? nullptr : &found->second;
}

}  // namespace panache::cli
