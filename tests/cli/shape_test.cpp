// How much of a style is given: --posture, --dynamics, --timing and --region.

#include "base/quat.h"
#include "cli/program.h"
#include "clip/motion_format.h"

namespace panache::test {
namespace {

class ShapeOptions : public ProgramTest {
 protected:
  std::string restyled(std::vector<std::string> more) {
    write_walk("walk.bvh");
    std::vector<std::string> arguments = {"stylize", "walk.bvh", "--style", "old=1",
                                          "--force", "-o",       "out.bvh"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Ran ran = run(arguments);
    EXPECT_EQ(ran.exit, 0) << ran.err;
    return read("out.bvh");
  }
  std::string rejection(const std::string& verb, std::vector<std::string> more) {
    write_walk("walk.bvh");
    std::vector<std::string> arguments = {verb, "--style", "old=1"};
    if (verb == "stylize") arguments.insert(arguments.end(), {"walk.bvh", "-o", "out.bvh"});
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Ran ran = run(arguments);
    EXPECT_EQ(ran.exit, 2);
    EXPECT_FALSE(exists("out.bvh"));
    return ran.err;
  }
};

TEST_F(ShapeOptions, all_at_one_is_the_whole_style) {
  EXPECT_TRUE(restyled({"--posture", "1", "--dynamics", "1", "--timing", "1", "--region", "legs=1",
                        "--region", "torso=1"}) == restyled({}));
}

TEST_F(ShapeOptions, each_changes_the_result) {
  const std::string whole = restyled({});
  for (const std::vector<std::string>& more :
       {std::vector<std::string>{"--posture", "0.5"}, {"--dynamics", "0"}}) {
    EXPECT_TRUE(restyled(more) != whole) << more[0];
  }
}

TEST_F(ShapeOptions, without_timing_and_an_arm_those_are_the_inputs) {
  restyled({"--timing", "0"});
  const auto whole = read_motion(path("out.bvh"));
  restyled({"--timing", "0", "--region", "left_arm=0"});
  const auto without = read_motion(path("out.bvh")), walk = read_motion(path("walk.bvh"));
  ASSERT_TRUE(whole.ok() && without.ok() && walk.ok());
  const Clip &a = (*whole)->clip(), &b = (*without)->clip(), &in = (*walk)->clip();
  ASSERT_EQ(b.frames, in.frames);
  // How far the rotations of joints whose name begins so are from those of another clip.
  const auto apart = [&](const Clip& other, const std::string& name) {
    float max = 0;
    for (int f = 0; f < b.frames; ++f) {
      for (size_t j = 0; j < b.joints(); ++j) {
        if (!b.skeleton.joints[j].name.starts_with(name)) continue;
        const Quat turn = conjugate(b.pose(f).rotations[j]) * other.pose(f).rotations[j];
        max = std::max(max, length(turn.xyz()));
      }
    }
    return max;
  };
  constexpr float kRounding = 1e-5f;  // Of floats, and of six decimals of a degree.
  for (const char* joint : {"leftUpperArm", "leftLowerArm", "leftHand"}) {
    EXPECT_LT(apart(in, joint), kRounding) << joint;
    EXPECT_GT(apart(a, joint), 0.01f) << joint;
  }
  for (const char* joint : {"rightUpperArm", "rightLowerArm", "rightHand"}) {
    // Hands that swing past each other are told apart from both arms.
    EXPECT_LT(apart(a, joint), 1e-3f) << joint;
    EXPECT_GT(apart(in, joint), 0.01f) << joint;
  }
}

TEST_F(ShapeOptions, a_wrong_region_is_rejected) {
  for (const char* verb : {"stylize", "live"}) {
    EXPECT_EQ(rejection(verb, {"--region", "tail=1"}),
              "panache: --region 'tail=1': expected legs, torso, left_arm or right_arm, '=' and an "
              "amount, such as legs=0.5\n");
    EXPECT_EQ(rejection(verb, {"--region", "legs=3"}),
              "panache: --region 'legs=3': expected an amount of 0 to 2, found '3'\n");
    EXPECT_EQ(rejection(verb, {"--region", "legs=1", "--region", "legs=0"}),
              "panache: --region legs is given twice\n");
    EXPECT_NE(rejection(verb, {"--contacts", "2"}).find("--contacts"), std::string::npos);
  }
}

}  // namespace
}  // namespace panache::test
