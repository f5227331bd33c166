#pragma once
// A file on its way to its name.

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "base/result.h"

namespace panache {

// A new file beside its target, ".NAME.PID.part", with the number of this process; ours alone. A
// lock, which ends with the process that holds it, tells it from one that a killed process left.
class PartFile {
 public:
  // Removes what killed processes left of this target, too. `path` is what messages call the
  // target.
  static Result<PartFile> open(const std::string& target, const std::string& path);
  PartFile(PartFile&& other) noexcept;
  PartFile& operator=(PartFile&&) = delete;
  ~PartFile();  // Removes it, unless it was kept.

  // These three set errno where they fail. All bytes at once:
  bool write(std::string_view bytes);
  bool set_permissions(std::filesystem::perms permissions);
  // Makes it the target; EEXIST where there is one, unless it may `replace` it.
  bool keep(bool replace);

 private:
  PartFile(std::string target, std::string name, int file);

  // Those of each operating system. The file is new, ours and locked; -1 sets errno.
  static int create(const std::string& name);
  // Whether `name` is a file of ours that no process is writing: not `pid`, nor any other.
  static bool is_abandoned(const std::string& name, long pid);
  static size_t longest_name(const std::filesystem::path& folder);  // In bytes.

  static void remove_abandoned(const std::filesystem::path& folder, const std::string& stem);

  std::string target_, name_;  // The name is empty where nothing is left to remove.
  int file_;
};

}  // namespace panache
