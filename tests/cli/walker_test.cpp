// panache walker: sample input on any machine.

#include "cli/program.h"
#include "clip/motion_file.h"

namespace panache::test {
namespace {

class WalkerVerb : public ProgramTest {
 protected:
  void expect_rejected(std::vector<std::string> arguments, int exit, const std::string& message) {
    arguments.insert(arguments.begin(), "walker");
    const Ran ran = run(arguments);
    EXPECT_EQ(ran.err, "panache: " + message + "\n");
    EXPECT_EQ(ran.exit, exit);
  }
};

TEST_F(WalkerVerb, makes_a_walk_that_stylize_takes) {
  const Ran ran = run({"walker", "-o", "walk.bvh", "--seconds", "2", "--fps", "30"});
  ASSERT_EQ(ran.exit, 0) << ran.err;
  EXPECT_EQ(ran.out, "walked 2.0 s (60 frames) into walk.bvh\n");
  const auto file = read_motion(path("walk.bvh"));
  ASSERT_TRUE(file.ok()) << file.error().message;
  EXPECT_EQ((*file)->clip().frames, 60);
  // 1.4 m/s for 59 frame times, to a tenth: the body sways.
  const Vec3 begin = (*file)->clip().pose(0).translations[0];
  const Vec3 end = (*file)->clip().pose(59).translations[0];
  EXPECT_NEAR(length(end - begin), 1.4f * 59 / 30, 0.1f * 1.4f * 59 / 30);
  EXPECT_EQ(run({"stylize", "walk.bvh", "--style", "old=1", "-o", "old.bvh"}).exit, 0);
}

TEST_F(WalkerVerb, explains_a_wrong_wish) {
  expect_rejected({"-o", "walk.bvh", "--speed", "9"}, 2,
                  "--speed: expected a number from 0 to 4.5, found 9");
  expect_rejected({"-o", "walk.bvh", "--speed", "nan"}, 2,
                  "--speed: expected a number from 0 to 4.5, found nan");
  expect_rejected({"-o", "walk.bvh", "--seconds", "0"}, 2,
                  "--seconds: expected a number from 0.1 to 600, found 0");
  expect_rejected({"-o", "walk.bvh", "--fps", "1000"}, 2,
                  "--fps: expected a number from 10 to 240, found 1000");
  expect_rejected({"-o", "walk.bvh", "--turn", "-500"}, 2,
                  "--turn: expected a number from -120 to 120, found -500 at --speed 1.4");
  expect_rejected({"-o", "walk.fbx"}, 2, "walk.fbx: expected a name that ends in .bvh");
  expect_rejected({"-o", "walk.bvh", "--model", "none.safetensors"}, 1,
                  "none.safetensors: cannot be read: No such file or directory");
  EXPECT_FALSE(exists("walk.bvh"));
}

TEST_F(WalkerVerb, keeps_an_existing_file_without_force) {
  write("walk.bvh", "mine");
  expect_rejected({"-o", "walk.bvh"}, 1, "walk.bvh: exists already; --force overwrites it");
  EXPECT_EQ(read("walk.bvh"), "mine");
}

}  // namespace
}  // namespace panache::test
