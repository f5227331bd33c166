#include "base/os/part_file.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <map>
#include <mutex>
#include <utility>
#include <vector>

#include "base/os/os.h"

namespace panache {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kExtension = ".part";
constexpr int kMaxTries = 1000;
constexpr size_t kNumberRoom = 16;  // For ".PID-TRY".

// The process ID in ".STEM.PID.part" or ".STEM.PID-TRY.part"; 0 for any other name.
long pid_in(std::string_view name, std::string_view stem) {
  if (!name.starts_with(stem) || !name.ends_with(kExtension)) return 0;
  if (name.size() <= stem.size() + kExtension.size()) return 0;
  name = name.substr(stem.size(), name.size() - stem.size() - kExtension.size());
  const size_t dash = std::min(name.find('-'), name.size());
  const auto number = [](std::string_view digits) -> long {
    if (digits.empty() || digits.size() > 9 || digits[0] == '0') return 0;
    long value = 0;
    for (const char digit : digits) {
      if (digit < '0' || digit > '9') return 0;
      value = 10 * value + (digit - '0');
    }
    return value;
  };
  if (dash < name.size() && number(name.substr(dash + 1)) == 0) return 0;
  return number(name.substr(0, dash));
}

// The part files in a folder when this process first wrote there; listing the folder for each of n
// files would take n^2 time.
std::vector<std::string> parts_in(const fs::path& folder) {
  static std::mutex mutex;
  static std::map<fs::path, std::vector<std::string>> known;
  const std::lock_guard lock(mutex);
  const auto [at, is_new] = known.try_emplace(folder);
  std::error_code status;
  for (fs::directory_iterator entry(folder.empty() ? "." : folder, status), end;
       is_new && !status && entry != end; entry.increment(status)) {
    std::string name = entry->path().filename().string();
    if (name.starts_with('.') && name.ends_with(kExtension)) at->second.push_back(std::move(name));
  }
  return at->second;
}

// Cuts a name to fit, without splitting a UTF-8 character.
std::string shortened(std::string name, size_t size) {
  if (name.size() <= size) return name;
  while (size > 0 && (name[size] & 0xc0) == 0x80) --size;
  return name.substr(0, size);
}

}  // namespace

PartFile::PartFile(std::string target, std::string name, int file)
    : target_(std::move(target)), name_(std::move(name)), file_(file) {}

PartFile::PartFile(PartFile&& other) noexcept
    : target_(std::move(other.target_)),
      name_(std::exchange(other.name_, {})),
      file_(std::exchange(other.file_, -1)) {}

Result<PartFile> PartFile::open(const std::string& target, const std::string& path) {
  const fs::path folder = fs::path(target).parent_path();
  const std::string name = fs::path(target).filename().string();
  const size_t longest = longest_name(folder);
  if (name.size() > longest) errno = ENAMETOOLONG;
  const size_t room = longest - std::min(longest, kNumberRoom + kExtension.size());
  const std::string stem = shortened("." + name, room) + ".";
  remove_abandoned(folder, stem);
  for (int i = 1; i <= kMaxTries; ++i) {
    const std::string pid =
        std::to_string(process_number()) + (i == 1 ? "" : "-" + std::to_string(i));
    const std::string part = (folder / (stem + pid + std::string(kExtension))).string();
    const int file = create(part);
    if (file >= 0) return PartFile(target, part, file);
    if (errno != EEXIST) break;
  }
  return Error{path + ": cannot be written: " + std::strerror(errno)};
}

void PartFile::remove_abandoned(const fs::path& folder, const std::string& stem) {
  for (const std::string& name : parts_in(folder)) {
    const long pid = pid_in(name, stem);
    const fs::path part = folder / name;
    std::error_code status;
    if (pid != 0 && is_abandoned(part.string(), pid)) fs::remove(part, status);
  }
}

}  // namespace panache
