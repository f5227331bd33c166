// Real motion, from the folder in the environment variable PANACHE_DATA.

#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "fixtures.h"

namespace panache {
namespace {

constexpr const char* kNoData = "real motion is looked for in PANACHE_DATA, which is not set";

// The BVH files below folders of the data, sorted; every so many of them.
std::vector<std::string> data_files(const std::vector<std::string>& folders, size_t every = 1) {
  std::vector<std::string> paths;
  for (const std::string& folder : folders) {
    const auto root = std::filesystem::path(std::getenv("PANACHE_DATA")) / folder;
    std::error_code failure;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root, failure)) {
      if (entry.path().extension() == ".bvh") paths.push_back(entry.path().string());
    }
  }
  std::sort(paths.begin(), paths.end());
  std::vector<std::string> kept;
  for (size_t i = 0; i < paths.size(); i += every) kept.push_back(paths[i]);
  return kept;
}
std::vector<std::string> small_sets() { return data_files({"formats", "xia", "bandai-1"}); }

TEST(BvhData, every_file_comes_back_byte_for_byte) {
  if (!std::getenv("PANACHE_DATA")) GTEST_SKIP() << kNoData;
  std::vector<std::string> paths = small_sets();
  ASSERT_GT(paths.size(), 200u);
  // Its 3,000 files are of one skeleton.
  for (const std::string& path : data_files({"bandai-2"}, 4)) paths.push_back(path);
  for (const std::string& path : paths) {
    const std::string text = *read_file(path);
    const auto file = must_parse(text, path);
    ASSERT_TRUE(file);
    EXPECT_EQ(broken_promise(file->clip()), "") << path;
    EXPECT_TRUE(file->encode(file->clip(), same_frames(file->clip().frames)) == text) << path;
  }
}

TEST(BvhData, a_changed_joint_comes_back_as_it_was_changed) {
  if (!std::getenv("PANACHE_DATA")) GTEST_SKIP() << kNoData;
  const Quat change = axis_angle(normalized(Vec3{1, -2, 3}), 0.05f);
  double worst = 0;
  size_t turn = 0;
  for (const std::string& path : small_sets()) {
    const auto file = must_parse(*read_file(path), path);
    ASSERT_TRUE(file);
    Clip clip = file->clip();
    const size_t joint = turn++ % clip.joints();
    if (!clip.skeleton.joints[joint].can_rotate) continue;
    for (int i = 0; i < clip.frames; ++i) {
      Quat& q = clip.pose(i).rotations[joint];
      q = normalized(change * q);
    }
    const auto back = must_parse(file->encode(clip, same_frames(clip.frames)), path);
    ASSERT_TRUE(back);
    for (int i = 0; i < clip.frames; ++i) {
      for (size_t j = 0; j < clip.joints(); ++j) {
        const Quat written = back->clip().pose(i).rotations[j];
        worst = std::max(worst, angle_between(written, clip.pose(i).rotations[j]));
      }
    }
  }
  std::printf("worst rotation error %.2g radians\n", worst);
  EXPECT_LT(worst, 1e-5);  // Four decimals at least: three roundings of 9e-7 radians, and floats.
}

}  // namespace
}  // namespace panache
