#include "base/file.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>

#include "base/os/os.h"

namespace panache {

Result<std::string> read_file(const std::string& path) {
  std::error_code status;
  if (std::filesystem::is_directory(path, status)) {
    return Error{path + ": is a folder; expected a file"};
  }
  // Closes the file also where the memory for its bytes runs out.
  const auto close = [](std::FILE* open_file) { std::fclose(open_file); };
  const std::unique_ptr<std::FILE, decltype(close)> file(std::fopen(path.c_str(), "rb"), close);
  if (!file) return Error{path + ": cannot be read: " + std::strerror(errno)};
  std::string bytes;
  const auto size = std::filesystem::file_size(path, status);
  if (!status) bytes.reserve(size);
  char block[1 << 16];
  size_t n;
  while ((n = std::fread(block, 1, sizeof block, file.get())) > 0) bytes.append(block, n);
  if (std::ferror(file.get())) return Error{path + ": cannot be read: " + std::strerror(errno)};
  return bytes;
}

Result<void> write_file(const std::string& path, std::string_view bytes, bool force) {
  namespace fs = std::filesystem;
  std::error_code status;
  if (fs::is_directory(path, status)) return Error{path + ": is a folder; expected a file name"};
  if (!force && fs::exists(path, status)) {
    return Error{path + ": exists already"};
  }
  const fs::path parent = fs::path(path).parent_path();
  if (!parent.empty()) fs::create_directories(parent, status);

  const std::string part = path + ".part" + std::to_string(process_id());
  std::FILE* file = std::fopen(part.c_str(), "wb");
  if (!file) return Error{path + ": cannot be written: " + std::strerror(errno)};
  const bool written = std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size();
  const bool closed = std::fclose(file) == 0;
  std::string cause = std::strerror(errno);
  if (written && closed) {
    fs::rename(part, path, status);  // On Windows, too, it replaces a file that is there.
    cause = status.message();
  }
  if (!written || !closed || status) {
    std::remove(part.c_str());
    return Error{path + ": cannot be written: " + cause};
  }
  return {};
}

}  // namespace panache
