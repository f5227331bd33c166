// Real motion, from the folder in the environment variable PANACHE_DATA.

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <mutex>
#include <string_view>
#include <thread>

#include "fixtures.h"

namespace panache {
namespace {

constexpr const char* kNoData = "real motion is looked for in PANACHE_DATA, which is not set";

// The BVH files below a folder of the data, sorted.
std::vector<std::string> data_files(const std::string& folder) {
  std::vector<std::string> paths;
  const std::filesystem::path root = std::filesystem::path(std::getenv("PANACHE_DATA")) / folder;
  std::error_code failure;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(root, failure)) {
    if (entry.path().extension() == ".bvh") paths.push_back(entry.path().string());
  }
  std::sort(paths.begin(), paths.end());
  return paths;
}

std::vector<std::string> small_sets() {
  std::vector<std::string> paths;
  for (const char* folder : {"formats", "xia", "bandai-1"}) {
    for (std::string& path : data_files(folder)) paths.push_back(std::move(path));
  }
  return paths;
}

std::vector<std::string_view> split(std::string_view text) {
  std::vector<std::string_view> out;
  constexpr const char* kSpace = " \t\r\n";
  for (size_t at = text.find_first_not_of(kSpace); at != std::string_view::npos;) {
    const size_t end = std::min(text.find_first_of(kSpace, at), text.size());
    out.push_back(text.substr(at, end - at));
    at = text.find_first_not_of(kSpace, end);
  }
  return out;
}

TEST(BvhData, every_file_comes_back_byte_for_byte) {
  if (!std::getenv("PANACHE_DATA")) GTEST_SKIP() << kNoData;
  const auto paths = small_sets();
  ASSERT_GT(paths.size(), 200u);
  for (const std::string& path : paths) {
    const std::string text = *read_file(path);
    const auto file = must_parse(text, path);
    ASSERT_TRUE(file);
    EXPECT_EQ(broken_promise(file->clip()), "") << path;
    EXPECT_TRUE(file->encode(file->clip(), same_frames(file->clip().frames)) == text) << path;
  }
}

// Where the numbers of each joint stand in a frame, from the words of the file alone.
struct Columns {
  std::vector<size_t> first;      // [joints + 1]
  std::vector<size_t> rotations;  // [joints]
  size_t first_word = 0;          // The first number among the words.
};
Columns columns_of(const std::vector<std::string_view>& words) {
  Columns columns;
  columns.first = {0};
  for (size_t i = 0; i < words.size(); ++i) {
    if (words[i] == "CHANNELS") {
      const size_t count = std::stoul(std::string(words[i + 1]));
      columns.first.push_back(columns.first.back() + count);
      size_t rotations = 0;
      for (size_t k = 0; k < count; ++k) rotations += words[i + 2 + k].ends_with("rotation");
      columns.rotations.push_back(rotations);
    }
    if (words[i] == "Time:") columns.first_word = i + 2;
  }
  return columns;
}

// How often a number jumps by more than 170 degrees from one frame to the next.
int jumps(const std::vector<std::string_view>& words, const Columns& columns, size_t joint) {
  int count = 0;
  const size_t stride = columns.first.back();
  const size_t end = columns.first[joint + 1], begin = end - columns.rotations[joint];
  for (size_t at = columns.first_word; at + 2 * stride <= words.size(); at += stride) {
    for (size_t k = begin; k < end; ++k) {
      const double step =
          std::stod(std::string(words[at + stride + k])) - std::stod(std::string(words[at + k]));
      count += std::abs(step) > 170;
    }
  }
  return count;
}

TEST(BvhData, only_the_changed_joint_gets_new_numbers_and_they_are_right) {
  if (!std::getenv("PANACHE_DATA")) GTEST_SKIP() << kNoData;
  const Quat change = axis_angle(normalized(Vec3{1, -2, 3}), 0.05f);
  double worst = 0;
  int jumps_before = 0, jumps_after = 0;
  size_t turn = 0;
  for (const std::string& path : small_sets()) {
    const std::string text = *read_file(path);
    const auto file = must_parse(text, path);
    ASSERT_TRUE(file);
    Clip clip = file->clip();
    const size_t joint = turn++ % clip.joints();
    if (!clip.skeleton.joints[joint].can_rotate) continue;
    for (int i = 0; i < clip.frames; ++i) {
      Quat& q = clip.pose(i).rotations[joint];
      q = normalized(change * q);
    }
    const std::string out = file->encode(clip, same_frames(clip.frames));
    const auto back = must_parse(out, path);
    ASSERT_TRUE(back);
    for (int i = 0; i < clip.frames; ++i) {
      worst = std::max(worst, angle_between(back->clip().pose(i).rotations[joint],
                                            clip.pose(i).rotations[joint]));
    }
    const auto before = split(text), after = split(out);
    ASSERT_EQ(before.size(), after.size()) << path;
    const Columns columns = columns_of(before);
    const size_t stride = columns.first.back();
    size_t others_changed = 0;
    for (size_t w = 0; w < before.size(); ++w) {
      const size_t column = w < columns.first_word ? stride : (w - columns.first_word) % stride;
      const bool own = column < columns.first[joint + 1] &&
                       column >= columns.first[joint + 1] - columns.rotations[joint];
      others_changed += !own && before[w] != after[w];
    }
    EXPECT_EQ(others_changed, 0u) << path;
    const int jumps_here = jumps(before, columns, joint),
              jumps_there = jumps(after, columns, joint);
    jumps_before += jumps_here;
    jumps_after += jumps_there;
    EXPECT_LE(jumps_there, jumps_here) << path;
  }
  std::printf("worst rotation error %.2g radians, leaps of an angle %d in the files, %d written\n",
              worst, jumps_before, jumps_after);
  EXPECT_LT(worst, 1e-5);  // Four decimals at least: three roundings of 9e-7 radians, and floats.
}

TEST(BvhData, the_largest_set_keeps_what_a_clip_promises) {
  if (!std::getenv("PANACHE_DATA")) GTEST_SKIP() << kNoData;
  const auto paths = data_files("bandai-2");
  if (paths.empty()) GTEST_SKIP() << "bandai-2 is not unpacked in PANACHE_DATA";
  constexpr size_t kEvery = 4;  // Its 3,000 files are of one skeleton.
  std::atomic<size_t> next = 0, frames = 0, bytes = 0;
  std::mutex complaint;
  const auto work = [&] {
    for (size_t i; (i = kEvery * next++) < paths.size();) {
      auto text = read_file(paths[i]);
      bytes += text.ok() ? text->size() : 0;
      auto file = text.ok() ? parse_bvh(std::move(*text), paths[i])
                            : Result<std::unique_ptr<MotionFile>>(text.error());
      const std::string broken = file.ok() ? broken_promise((*file)->clip()) : file.error().message;
      if (file.ok()) frames += static_cast<size_t>((*file)->clip().frames);
      const std::lock_guard lock(complaint);
      EXPECT_EQ(broken, "") << paths[i];
    }
  };
  std::thread second(work);
  work();
  second.join();
  EXPECT_GT(frames.load(), 50'000u);
  std::printf("%zu of %zu files, %.0f MB, %zu frames\n", (paths.size() + kEvery - 1) / kEvery,
              paths.size(), static_cast<double>(bytes) / 1e6, frames.load());
}

}  // namespace
}  // namespace panache
