#pragma once
// A file on its way to its name.

#include <filesystem>
#include <string>
#include <string_view>

#include "base/result.h"

namespace panache {

// TARGET.part, ours alone for as long as it is open: a lock, which ends with the process that holds
// it, tells a file that is being written from one that a killed process left.
class PartFile {
 public:
  // `path` is what messages call the target.
  static Result<PartFile> open(const std::string& target, const std::string& path);
  PartFile(PartFile&& other) noexcept;
  PartFile& operator=(PartFile&&) = delete;
  ~PartFile();  // Removes it, unless it was kept.

  // These three set errno where they fail. All bytes at once, in place of what is in it:
  bool write(std::string_view bytes);
  bool set_permissions(std::filesystem::perms permissions);
  // Makes it the target.
  bool keep();

 private:
  PartFile(std::string target, std::string name, int file);
  std::string target_, name_;  // The name is empty where the file is not ours to remove.
  int file_;
};

}  // namespace panache
