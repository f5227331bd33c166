#include "base/os/part_file.h"

#include <utility>

namespace panache {

PartFile::PartFile(std::string target, std::string name, int file)
    : target_(std::move(target)), name_(std::move(name)), file_(file) {}

PartFile::PartFile(PartFile&& other) noexcept
    : target_(std::move(other.target_)),
      name_(std::exchange(other.name_, {})),
      file_(std::exchange(other.file_, -1)) {}

}  // namespace panache
