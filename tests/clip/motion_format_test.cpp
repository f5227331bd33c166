#include <filesystem>

#include "base/file.h"
#include "clip/motion_file.h"
#include "clip/motion_format.h"
#include "fixtures.h"
#include "make_clip.h"

namespace panache {
namespace {

TEST(MotionFormat, each_is_found_by_its_extension_and_named_once) {
  for (const MotionFormat& format : motion_formats()) {
    EXPECT_EQ(find_format(motion_formats(), format.extension), &format);
    EXPECT_EQ(format.extension, extension_of("walk" + std::string(format.extension)));
    EXPECT_TRUE(format.parse) << format.extension;
  }
  EXPECT_EQ(find_format(motion_formats(), ".npz"), nullptr);
  EXPECT_EQ(list_extensions(motion_formats()), ".bvh, .glb, .gltf, .vrm, .vrma, .amc, .fbx");
}

TEST(MotionFormat, what_one_writes_it_reads) {
  const Clip clip = test::walking_clip(20);
  int written = 0;
  for (const MotionFormat& format : motion_formats()) {
    if (!format.write) continue;
    ++written;
    const std::string bytes = format.write(clip, "walk", {}, nullptr);
    const auto file = format.parse(bytes, "walk", {});
    ASSERT_TRUE(file.ok()) << file.error().message;
    EXPECT_EQ((*file)->clip().frames, 20) << format.extension;
    EXPECT_EQ(format.encoded_as, format.extension);
    const auto by_name = parse_motion(bytes, "walk" + std::string(format.extension));
    ASSERT_TRUE(by_name.ok()) << by_name.error().message;
    EXPECT_EQ((*by_name)->clip().rotations, (*file)->clip().rotations);
  }
  EXPECT_EQ(
      parse_motion("", "walk.c3d").error().message,
      "walk.c3d: expected a motion file (.bvh, .glb, .gltf, .vrm, .vrma, .amc, .fbx), found the "
      "extension '.c3d'");
  EXPECT_EQ(written, 3);
}

TEST(MotionFormat, a_format_of_a_program_of_its_own_is_read_like_the_others) {
  static std::string asked;
  constexpr MotionFormat kOwn[] = {{.extension = ".own",
                                    .read = [](const std::string& path, const ReadOptions&)
                                        -> Result<std::unique_ptr<MotionFile>> {
                                      asked = path;
                                      return Error{path + ": is none"};
                                    },
                                    .encoded_as = ".own"}};
  EXPECT_EQ(read_motion("nowhere/walk.OWN", kOwn).error().message, "nowhere/walk.OWN: is none");
  EXPECT_EQ(asked, "nowhere/walk.OWN");
  const std::string other = testing::TempDir() + "panache_motion_format.bvh";
  ASSERT_TRUE(write_file(other, "", true).ok());
  EXPECT_EQ(read_motion(other, kOwn).error().message,
            other + ": expected a motion file (.own), found the extension '.bvh'");
  std::filesystem::remove(other);
  // As a manifest is read.
  set_motion_formats(kOwn);
  EXPECT_EQ(read_motion("nowhere/run.own").error().message, "nowhere/run.own: is none");
  set_motion_formats(motion_formats());
  EXPECT_EQ(asked, "nowhere/run.own");
}

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

}  // namespace
}  // namespace panache
