// Files are written whole or not at all, and nothing of the user's is lost on the way.

#include "base/file.h"

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <string>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <gtest/gtest.h>

#include "temporary_folder.h"

namespace panache {
namespace {

namespace fs = std::filesystem;

class WriteFile : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return folder_.path() + name; }
  std::string rejection(const std::string& name, bool force) const {
    const Result<void> written = write_file(path(name), "new", force);
    return written ? "" : written.error().message.substr(path("").size());
  }
  size_t entries() const {
    return static_cast<size_t>(
        std::distance(fs::directory_iterator(path("")), fs::directory_iterator()));
  }
  test::TemporaryFolder folder_;
};

TEST_F(WriteFile, makes_folders_and_leaves_nothing_else) {
  ASSERT_TRUE(write_file(path("a/b/c"), "text", false).ok());
  EXPECT_EQ(*read_file(path("a/b/c")), "text");
  EXPECT_EQ(std::distance(fs::directory_iterator(path("a/b")), fs::directory_iterator()), 1);
}

TEST_F(WriteFile, a_file_of_more_than_2_GB_is_rejected_before_it_is_read) {
  ASSERT_TRUE(write_file(path("large"), "", false).ok());
  fs::resize_file(path("large"), kMaxFileBytes + 1);  // Takes no room: it is one hole.
  const Result<std::string> bytes = read_file(path("large"));
  ASSERT_FALSE(bytes.ok());
  EXPECT_EQ(bytes.error().message,
            path("large") + ": is larger than 2 GB; expected a smaller file");
}

TEST_F(WriteFile, what_may_never_end_is_not_read) {
  ASSERT_EQ(::mkfifo(path("pipe").c_str(), 0600), 0);
  fs::create_symlink("pipe", path("link"));
  for (const std::string& name : {path("pipe"), path("link"), std::string("/dev/zero")}) {
    const Result<std::string> bytes = read_file(name);
    ASSERT_FALSE(bytes.ok());
    EXPECT_EQ(bytes.error().message,
              name + ": is a device, pipe or socket; expected a regular file");
  }
}

TEST_F(WriteFile, a_pipe_that_is_open_already_is_read_as_a_shell_hands_it_over) {
  for (const std::string folder : {"/dev/fd/", "/proc/self/fd/"}) {
    int ends[2];
    ASSERT_EQ(::pipe(ends), 0);
    ASSERT_EQ(::write(ends[1], "text", 4), 4);
    ::close(ends[1]);
    const Result<std::string> bytes = read_file(folder + std::to_string(ends[0]));
    ::close(ends[0]);
    ASSERT_TRUE(bytes.ok()) << bytes.error().message;
    EXPECT_EQ(*bytes, "text");
  }
}

TEST_F(WriteFile, an_existing_file_is_replaced_only_by_force) {
  ASSERT_TRUE(write_file(path("a"), "old and longer", false).ok());
  EXPECT_EQ(rejection("a", false), "a: exists already");
  EXPECT_EQ(*read_file(path("a")), "old and longer");
  EXPECT_EQ(rejection("a", true), "");
  EXPECT_EQ(*read_file(path("a")), "new");
}

TEST_F(WriteFile, force_keeps_permissions) {
  ASSERT_TRUE(write_file(path("a"), "old", false).ok());
  for (const fs::perms permissions : {fs::perms(0640), fs::perms(0755), fs::perms(0604)}) {
    fs::permissions(path("a"), permissions);
    EXPECT_EQ(rejection("a", true), "");
    EXPECT_EQ(fs::status(path("a")).permissions(), permissions);
  }
}

TEST_F(WriteFile, force_writes_to_where_a_link_points) {
  ASSERT_TRUE(write_file(path("folder/a"), "old", false).ok());
  fs::create_symlink("folder/a", path("link"));
  EXPECT_EQ(rejection("link", true), "");
  EXPECT_TRUE(fs::is_symlink(path("link")));
  EXPECT_EQ(*read_file(path("folder/a")), "new");
}

TEST_F(WriteFile, what_is_no_regular_file_is_never_replaced) {
  ASSERT_EQ(::mkfifo(path("pipe").c_str(), 0600), 0);
  fs::create_directory(path("folder"));
  for (const bool force : {false, true}) {
    EXPECT_EQ(rejection("pipe", force),
              "pipe: is a device, pipe or socket, which is not replaced; expected a file name");
    EXPECT_EQ(rejection("folder", force), "folder: is a folder; expected a file name");
  }
  EXPECT_TRUE(fs::is_fifo(path("pipe")));
  EXPECT_EQ(entries(), 2u);
}

TEST_F(WriteFile, what_a_killed_process_left_is_used_up) {
  ASSERT_TRUE(
      write_file(path("a.part"), "half of something that is longer than the rest", false).ok());
  EXPECT_EQ(rejection("a", false), "");
  EXPECT_EQ(*read_file(path("a")), "new");
  EXPECT_EQ(entries(), 1u);
}

TEST_F(WriteFile, what_another_process_is_writing_is_left_alone) {
  const int other = ::open(path("a.part").c_str(), O_WRONLY | O_CREAT, 0600);
  ASSERT_EQ(::flock(other, LOCK_EX), 0);
  ASSERT_EQ(::write(other, "theirs", 6), 6);
  EXPECT_EQ(rejection("a", false), "a: is being written by another process");
  EXPECT_FALSE(fs::exists(path("a")));
  EXPECT_EQ(*read_file(path("a.part")), "theirs");
  ::close(other);
  EXPECT_EQ(rejection("a", false), "");
}

TEST_F(WriteFile, a_link_in_place_of_the_part_is_not_followed) {
  ASSERT_TRUE(write_file(path("precious"), "theirs", false).ok());
  fs::create_symlink("precious", path("a.part"));
  EXPECT_TRUE(rejection("a", false).starts_with("a: cannot be written: "));
  EXPECT_EQ(*read_file(path("precious")), "theirs");
}

TEST_F(WriteFile, too_many_open_files_are_named_as_the_cause) {
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_NOFILE, &before), 0);
  const int next = ::dup(STDIN_FILENO);
  ASSERT_GE(next, 0);
  ::close(next);
  for (const rlim_t room : {0, 1}) {  // None for the file, or for the file alone.
    const rlimit fewer = {static_cast<rlim_t>(next) + room, before.rlim_max};
    const std::string out = path("a");
    ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &fewer), 0);
    // And nothing else here: the sanitizers open files to look at objects.
    const Result<void> written = write_file(out, "new", false);
    ::setrlimit(RLIMIT_NOFILE, &before);
    ASSERT_FALSE(written.ok());
    EXPECT_EQ(written.error().message, out + ": cannot be written: Too many open files");
    EXPECT_EQ(entries(), 0u);
  }
}

TEST_F(WriteFile, a_full_disk_leaves_nothing) {
  // A limit on the size of files stands in for it.
  const auto fill = [&] {
    ::signal(SIGXFSZ, SIG_IGN);
    rlimit none{};
    ::setrlimit(RLIMIT_FSIZE, &none);
    const bool good = rejection("a", false) == "a: cannot be written: File too large";
    std::_Exit(good && entries() == 0 ? 0 : 1);
  };
  EXPECT_EXIT(fill(), testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace panache
