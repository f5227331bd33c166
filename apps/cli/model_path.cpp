#include "model_path.h"

#include <cstdlib>
#include <filesystem>

#include "base/file.h"
#include "base/os/os.h"

namespace panache::cli {

namespace fs = std::filesystem;

Result<std::string> find_shipped(const std::string& file_name) {
  std::error_code status;
  const fs::path folder = fs::path(program_path()).parent_path();
  std::string looked;
  for (const char* models : {"../share/panache/models", "models", "../../models"}) {
    const fs::path path = (folder / models / file_name).lexically_normal();
    if (fs::exists(path, status)) return path.string();
    if (!looked.empty()) looked += ", ";
    looked += path.string();
  }
  return Error{"the model " + file_name + " was not found; searched " + looked};
}

Result<std::string> find_model(const std::string& given, const std::string& file_name) {
  if (!given.empty()) return given;
  const char* named = std::getenv("PANACHE_MODEL");
  if (named && *named) return std::string(named);
  Result<std::string> shipped = find_shipped(file_name);
  if (shipped) return shipped;
  return Error{shipped.error().message +
               "; --model FILE or the environment variable PANACHE_MODEL names another"};
}

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
  const std::string target = std::filesystem::canonical(path, status).string();
  return write_file(target, format_safetensors(model), true);
}

}  // namespace panache::cli
