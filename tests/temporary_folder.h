#pragma once
// A folder of a test's own: tests run side by side in processes of their own.

#include <cstdlib>
#include <filesystem>
#include <string>

#include <gtest/gtest.h>

namespace panache::test {

class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = testing::TempDir() + "panache-test-XXXXXX";
    if (::mkdtemp(name.data()) == nullptr) std::abort();
    path_ = name + "/";
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::string& path() const { return path_; }  // Ends in '/'.

 private:
  std::string path_;
};

}  // namespace panache::test
