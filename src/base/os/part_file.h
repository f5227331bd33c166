#pragma once
// A temporary file that becomes its target when it is complete.

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "base/result.h"

namespace panache {

// A new file next to its target, ".NAME.PID.part", with the ID of this process, which owns it. It
// is locked as long as the process lives; files that killed processes left are not.
class PartFile {
 public:
  // Also removes what killed processes left for this target. Messages call the target `path`.
  static Result<PartFile> open(const std::string& target, const std::string& path);
  PartFile(PartFile&& other) noexcept;
  PartFile& operator=(PartFile&&) = delete;
  ~PartFile();  // Removes the file unless it was kept.

  // The next three set errno on failure. Writes all bytes:
  bool write(std::string_view bytes);
  bool set_permissions(std::filesystem::perms permissions);
  // Renames the file to its target; fails with EEXIST if there is one, unless `replace`.
  bool keep(bool replace);

 private:
  PartFile(std::string target, std::string name, int file);

  // Implemented for each operating system. The file is new, ours and locked; -1 sets errno.
  static int create(const std::string& name);
  // Whether `name` is our file and no process is writing it, neither `pid` nor another.
  static bool is_abandoned(const std::string& name, long pid);
  static size_t longest_name(const std::filesystem::path& folder);  // In bytes.

  static void remove_abandoned(const std::filesystem::path& folder, const std::string& stem);

  std::string target_, name_;  // The name is empty if nothing is left to remove.
  int file_;
};

}  // namespace panache
