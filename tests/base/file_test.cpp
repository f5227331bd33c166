// Files are written whole or not at all, and nothing of the user's is lost on the way.

#include "base/file.h"

#include <atomic>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <gtest/gtest.h>

#include "base/os/part_file.h"
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
  void write_raw(const std::string& name, const std::string& text) const {
    std::ofstream(path(name)) << text;
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

TEST_F(WriteFile, what_is_never_meant_is_named_with_its_cure) {
  const auto message = [&](const std::string& bytes) {
    write_raw("a.bvh", bytes);
    const auto text = read_file(path("a.bvh"));
    return text ? "(read)" : text.error().message.substr(path("").size());
  };
  EXPECT_EQ(message("version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 9\n"),
            "a.bvh: is a pointer of Git LFS instead of the file; 'git lfs pull' fetches it");
  const std::string utf16 =
      "a.bvh: is text in UTF-16; expected UTF-8: save it so in an editor, or by 'iconv -f UTF-16 "
      "-t UTF-8'";
  EXPECT_EQ(message(std::string("\xff\xfeH\0I\0E\0R\0", 10)), utf16);
  EXPECT_EQ(message(std::string("\xfe\xff\0H\0I\0E\0R", 10)), utf16);
  // A model whose header has 65,279 bytes.
  EXPECT_EQ(message(std::string("\xff\xfe\0\0\0\0\0\0{\"", 10)), "(read)");
  EXPECT_EQ(message("\xef\xbb\xbfHIERARCHY"), "(read)");
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

// A process that lives no more.
pid_t dead_process() {
  const pid_t child = ::fork();
  if (child == 0) ::_exit(0);
  ::waitpid(child, nullptr, 0);
  return child;
}

TEST_F(WriteFile, no_other_file_is_touched_whatever_its_name) {
  const std::string pid = std::to_string(::getpid()), dead = std::to_string(dead_process());
  write_raw("precious", "theirs");
  const std::vector<std::string> theirs = {"a.part",
                                           "a.part.part",
                                           ".a.part",
                                           ".a." + pid + ".part",  // Our own next name.
                                           "a." + dead + ".part",
                                           ".b." + dead + ".part",
                                           ".a." + dead + ".part2",
                                           ".a.0" + dead + ".part",
                                           ".a.-1.part",
                                           ".a..part",
                                           ".a.99999999999999999999.part"};
  for (const std::string& name : theirs) write_raw(name, "theirs");
  fs::create_hard_link(path("precious"), path("link.part"));
  // Of a dead process by their names, but not left by a write.
  fs::create_symlink("precious", path(".a." + std::to_string(dead_process()) + ".part"));
  fs::create_directory(path(".a." + std::to_string(dead_process()) + ".part"));
  const size_t before = entries();
  for (const bool force : {false, true}) {
    EXPECT_EQ(rejection("a", force), "");
    EXPECT_EQ(rejection("link", force), "");
  }
  EXPECT_EQ(entries(), before + 2);
  for (const std::string& name : theirs) EXPECT_EQ(*read_file(path(name)), "theirs") << name;
  EXPECT_EQ(*read_file(path("precious")), "theirs");
  EXPECT_EQ(*read_file(path("a")), "new");
}

TEST_F(WriteFile, what_a_killed_process_left_of_a_file_goes_with_its_next_write) {
  write_raw(".a." + std::to_string(dead_process()) + ".part", "half of it");
  write_raw(".a." + std::to_string(dead_process()) + "-3.part", "half of it");
  EXPECT_EQ(rejection("a", false), "");
  EXPECT_EQ(*read_file(path("a")), "new");
  EXPECT_EQ(entries(), 1u);
}

TEST_F(WriteFile, what_another_process_is_writing_is_left_alone) {
  // Locked: the process lives, where its number may not tell.
  const std::string locked = ".a." + std::to_string(dead_process()) + ".part";
  const int other = ::open(path(locked).c_str(), O_WRONLY | O_CREAT, 0600);
  ASSERT_EQ(::flock(other, LOCK_EX), 0);
  write_raw(".a." + std::to_string(::getppid()) + ".part", "theirs");
  EXPECT_EQ(rejection("a", false), "");
  EXPECT_TRUE(fs::exists(path(locked)));
  EXPECT_EQ(entries(), 3u);
  ::close(other);
}

TEST_F(WriteFile, of_many_writers_one_wins_unless_they_may_overwrite) {
  for (const bool force : {false, true}) {
    const std::string name = force ? "b" : "a";
    std::atomic<int> written = 0;
    std::vector<std::thread> writers;
    for (int i = 0; i < 8; ++i) {
      writers.emplace_back([&, i] {
        const std::string text(100'000, static_cast<char>('a' + i));
        const Result<void> one = write_file(path(name), text, force);
        EXPECT_EQ(one ? "" : one.error().message, one ? "" : path(name) + ": exists already");
        written += one.ok();
      });
    }
    for (std::thread& writer : writers) writer.join();
    EXPECT_EQ(written, force ? 8 : 1);
    const std::string text = *read_file(path(name));
    EXPECT_EQ(text, std::string(100'000, text[0]));  // Whole, and of one writer.
  }
  EXPECT_EQ(entries(), 2u);
}

TEST_F(WriteFile, of_two_writes_at_once_the_first_to_end_wins) {
  Result<PartFile> first = PartFile::open(path("a"), "a");
  Result<PartFile> second = PartFile::open(path("a"), "a");
  ASSERT_TRUE(first.ok() && second.ok());
  ASSERT_TRUE(first->write("first") && second->write("second"));
  EXPECT_TRUE(first->keep(false));
  EXPECT_FALSE(second->keep(false));
  EXPECT_EQ(errno, EEXIST);
  EXPECT_EQ(*read_file(path("a")), "first");
  EXPECT_TRUE(second->keep(true));
  EXPECT_EQ(*read_file(path("a")), "second");
}

TEST_F(WriteFile, a_name_may_be_as_long_as_the_system_allows) {
  const std::string longest(255, 'a');
  EXPECT_EQ(rejection(longest, false), "");
  EXPECT_EQ(rejection(longest, true), "");
  EXPECT_EQ(*read_file(path(longest)), "new");
  const std::string umlauts = std::string(1, 'a') + [] {
    std::string text;
    for (int i = 0; i < 127; ++i) text += "\xc3\xa4";
    return text;
  }();
  EXPECT_EQ(rejection(umlauts, false), "");
  EXPECT_EQ(rejection(longest + "a", false), longest + "a: cannot be written: File name too long");
  EXPECT_EQ(entries(), 2u);
}

TEST_F(WriteFile, a_new_file_has_the_permissions_that_the_user_gives_to_new_files) {
  const mode_t before = ::umask(027);
  EXPECT_EQ(rejection("a", false), "");
  ::umask(before);
  EXPECT_EQ(fs::status(path("a")).permissions(), fs::perms(0640));
}

TEST_F(WriteFile, a_link_to_nothing_stays_and_gets_its_file) {
  fs::create_directory(path("folder"));
  fs::create_symlink("folder/second", path("first"));
  fs::create_symlink("a", path("folder/second"));
  EXPECT_EQ(rejection("first", false), "");
  EXPECT_TRUE(fs::is_symlink(path("first")));
  EXPECT_TRUE(fs::is_symlink(path("folder/second")));
  EXPECT_EQ(*read_file(path("folder/a")), "new");
  fs::create_symlink("round", path("round"));
  for (const bool force : {false, true}) {
    EXPECT_EQ(rejection("round", force),
              "round: cannot be written: Too many levels of symbolic links");
  }
  EXPECT_TRUE(fs::is_symlink(path("round")));
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
