#include "model_edit.h"

#include <filesystem>

#include "base/file.h"
#include "base/os/os.h"

namespace panache::cli {

Result<TensorFile> read_tensors(const std::string& path) {
  Result<std::string> bytes = read_file(path);
  if (!bytes) return bytes.error();
  return parse_safetensors(*bytes, path);
}

Result<void> check_writable(const std::string& path) {
  namespace fs = std::filesystem;
  std::error_code status;
  const fs::perms writers =
      fs::perms::owner_write | fs::perms::group_write | fs::perms::others_write;
  const bool read_only = (fs::status(path, status).permissions() & writers) == fs::perms::none;
  if (!read_only && is_writable(path)) return {};
  return Error{path + ": is read-only and stays as it is; change a copy of it, or allow writing"};
}

Result<void> replace_model(const std::string& path, const TensorFile& model) {
  std::error_code status;
  const std::string place = std::filesystem::canonical(path, status).string();
  return write_file(place, format_safetensors(model), true);
}

}  // namespace panache::cli
