#include "base/file.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <optional>
#include <system_error>

#include "base/os/part_file.h"

namespace panache {
namespace {

namespace fs = std::filesystem;

// Paths of files that this process has open already: its standard input, and what a shell passes
// for <(command).
bool is_open_already(const std::string& path) {
  return path == "/dev/stdin" || path.starts_with("/dev/fd/") || path.starts_with("/proc/self/fd/");
}

// Resolves symbolic links, even if there is no file yet; the system follows at most 40.
fs::path without_links(fs::path path, std::error_code& status) {
  for (int i = 0; i < 40; ++i) {
    if (!fs::is_symlink(fs::symlink_status(path, status))) {
      status.clear();  // The file does not exist.
      return path;
    }
    path = path.parent_path() / fs::read_symlink(path, status);
    if (status) return path;
  }
  status = std::make_error_code(std::errc::too_many_symbolic_link_levels);
  return path;
}

}  // namespace

Result<std::string> read_file(const std::string& path) {
  std::error_code status;
  const fs::file_status there = fs::status(path, status);
  if (fs::is_directory(there)) return Error{path + ": is a folder; expected a file"};
  // Opening a named pipe waits for a writer, and devices may never end.
  if (fs::exists(there) && !fs::is_regular_file(there) && !is_open_already(path)) {
    return Error{path + ": is a device, pipe or socket; expected a regular file"};
  }
  // Closes the file even if memory for its bytes runs out.
  const auto close = [](std::FILE* open_file) { std::fclose(open_file); };
  const std::unique_ptr<std::FILE, decltype(close)> file(std::fopen(path.c_str(), "rb"), close);
  if (!file) return Error{path + ": cannot be read: " + std::strerror(errno)};
  std::string bytes;
  const Error too_large{path + ": is larger than 2 GB; expected a smaller file"};
  const auto size = fs::file_size(path, status);
  if (!status && size > kMaxFileBytes) return too_large;
  if (!status) bytes.reserve(size);
  char block[1 << 16];
  while (!std::feof(file.get()) && !std::ferror(file.get())) {
    const size_t n = std::fread(block, 1, sizeof block, file.get());
    if (bytes.size() + n > kMaxFileBytes) return too_large;
    bytes.append(block, n);
  }
  if (std::ferror(file.get())) return Error{path + ": cannot be read: " + std::strerror(errno)};
  if (auto other = find_other_content(bytes, path)) return *other;
  return bytes;
}

std::optional<Error> find_other_content(std::string_view bytes, const std::string& path) {
  if (bytes.starts_with("version https://git-lfs")) {
    return Error{path + ": is a pointer of Git LFS instead of the file; 'git lfs pull' fetches it"};
  }
  // Letters of text in UTF-16 have a zero in every second byte, in either order.
  constexpr size_t kLooked = 8;
  const bool little = bytes.starts_with("\xff\xfe"), big = bytes.starts_with("\xfe\xff");
  if (bytes.size() < kLooked || !(little || big)) return std::nullopt;
  for (size_t i = 2; i < kLooked; ++i) {
    if ((bytes[i] == 0) != ((i % 2 == 1) == little)) return std::nullopt;
  }
  return Error{path +
               ": is text in UTF-16; expected UTF-8: save it so in an editor, or by 'iconv -f "
               "UTF-16 -t UTF-8'"};
}

Result<void> write_file(const std::string& path, std::string_view bytes, bool force) {
  std::error_code status;
  const fs::file_status there = fs::status(path, status);
  if (fs::is_directory(there)) return Error{path + ": is a folder; expected a file name"};
  if (fs::exists(there) && !fs::is_regular_file(there)) {
    return Error{path +
                 ": is a device, pipe or socket, which is not replaced; expected a file name"};
  }
  const Error taken{path + ": exists already", ErrorKind::file_exists};
  if (!force && fs::exists(there)) return taken;
  const fs::path parent = fs::path(path).parent_path();
  if (!parent.empty()) fs::create_directories(parent, status);
  const fs::path target = without_links(path, status);
  const std::string cannot = path + ": cannot be written: ";
  if (status) return Error{cannot + std::strerror(status.value())};

  Result<PartFile> part = PartFile::open(target.string(), path);
  if (!part) return part.error();
  if (part->write(bytes) && (!fs::exists(there) || part->set_permissions(there.permissions())) &&
      part->keep(force)) {
    return {};
  }
  if (!force && errno == EEXIST) return taken;  // Another process was faster.
  return Error{cannot + std::strerror(errno)};
}

}  // namespace panache
