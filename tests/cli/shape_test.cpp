// How much of a style is given: --posture, --dynamics, --timing and --region.

#include "cli/program.h"

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
  for (const std::vector<std::string>& more : {std::vector<std::string>{"--posture", "0.5"},
                                               {"--dynamics", "0"},
                                               {"--timing", "0"},
                                               {"--region", "left_arm=0"}}) {
    EXPECT_TRUE(restyled(more) != whole) << more[0];
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
  }
}

}  // namespace
}  // namespace panache::test
