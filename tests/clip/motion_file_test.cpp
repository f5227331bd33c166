#include "clip/motion_file.h"

#include <filesystem>

#include "base/file.h"
#include "fixtures.h"

namespace panache {
namespace {

std::string read_rejection(const std::string& path) {
  auto file = read_motion(path);
  return file.ok() ? "(accepted)" : file.error().message;
}

TEST(MotionFile, the_extension_decides_the_format_in_any_case) {
  const std::string folder = testing::TempDir() + "panache_motion_file";
  for (const char* name : {"/walk.bvh", "/walk.BVH", "/walk.neutral.Bvh"}) {
    ASSERT_TRUE(write_file(folder + name, read_fixture("plain.bvh"), true).ok());
    auto file = read_motion(folder + name);
    ASSERT_TRUE(file.ok()) << file.error().message;
    EXPECT_EQ((*file)->clip().frames, 3);
  }
  std::filesystem::remove_all(folder);
}

TEST(MotionFile, an_unknown_extension_is_answered_with_the_known_ones) {
  const std::string folder = testing::TempDir() + "panache_motion.file";
  for (const auto& [name, found] :
       {std::pair("/walk.c3d", "the extension '.c3d'"), std::pair("/walk", "no extension")}) {
    ASSERT_TRUE(write_file(folder + name, "", true).ok());
    EXPECT_EQ(read_rejection(folder + name),
              folder + name +
                  ": expected a motion file (.bvh, .glb, .gltf, .vrm, .vrma, .amc, .fbx), found " +
                  found);
  }
  std::filesystem::remove_all(folder);
  EXPECT_EQ(read_rejection("a/walk.fbx"), "a/walk.fbx: cannot be read: No such file or directory");
}

TEST(MotionFile, a_file_that_cannot_be_read_says_why) {
  EXPECT_EQ(read_rejection("nowhere/walk.bvh"),
            "nowhere/walk.bvh: cannot be read: No such file or directory");
}

}  // namespace
}  // namespace panache
