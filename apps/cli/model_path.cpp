#include "model_path.h"

#include <cstdlib>
#include <filesystem>

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

}  // namespace panache::cli
