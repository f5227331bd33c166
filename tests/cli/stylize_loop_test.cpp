// Loops in panache stylize and info, and what stylize says that it did.

#include <nlohmann/json.hpp>

#include "cli/program.h"
#include "clip/motion_file.h"
#include "pose/loop.h"

namespace panache::test {
namespace {

class StylizeLoop : public ProgramTest {
 protected:
  // How far the last pose of a file is from its first: at the worst joint, metres.
  float gap(const std::string& name) const {
    const auto file = read_motion(path(name));
    EXPECT_TRUE(file.ok()) << file.error().message;
    const Clip& clip = (*file)->clip();
    return measure_seam(clip, *Rig::create(clip)).worst;
  }
  Ran stylize(const Words& more) const {
    return run("stylize loop.bvh --style old=1 --force -o out.bvh" + more);
  }
};

std::string last_line(const std::string& text) {
  const size_t end = text.size() - 1;
  return text.substr(text.rfind('\n', end - 1) + 1, end - text.rfind('\n', end - 1) - 1);
}

TEST_F(StylizeLoop, closes_what_is_a_loop_and_says_so) {
  write_walk("loop.bvh", 31);
  const Ran found = stylize("--timing off");
  EXPECT_EQ(found.exit, 0) << found.err;
  EXPECT_TRUE(begins(last_line(found.out), "  loop.bvh: loop closed; ")) << found.out;
  EXPECT_TRUE(found.out.ends_with("% known motion\n")) << found.out;
  EXPECT_LT(gap("out.bvh"), 1e-3f);
  const Ran off = stylize("--timing off --loop off");
  EXPECT_FALSE(holds(off.out, "loop closed"));
  EXPECT_GT(gap("out.bvh"), 1e-3f);
  EXPECT_EQ(stylize("--quiet").out, "");
}

TEST_F(StylizeLoop, closes_what_is_none_where_asked_or_says_why_not) {
  write_walk("loop.bvh", 35);
  const Ran open = stylize({});
  EXPECT_FALSE(holds(open.out, "loop closed"));
  const Ran forced = stylize("--loop on");
  EXPECT_EQ(forced.exit, 0) << forced.err;
  EXPECT_TRUE(holds(forced.out, "loop closed (its ends were "));
  EXPECT_LT(gap("out.bvh"), 1e-3f);
  write_walk("loop.bvh", 39);
  const Ran apart = stylize("--loop on");
  EXPECT_EQ(apart.exit, 1);
  EXPECT_TRUE(begins(apart.err, "panache: loop.bvh: the motion is not a loop: its last pose is "));
  EXPECT_TRUE(apart.err.ends_with("; --loop auto leaves it open\n")) << apart.err;
  const Ran odd = stylize("--loop maybe");
  EXPECT_EQ(odd.exit, 2);
  EXPECT_EQ(odd.err, "panache: --loop 'maybe': expected auto, on or off\n");
}

TEST_F(StylizeLoop, the_report_has_the_figures) {
  write_walk("loop.bvh", 31);
  const auto facts = [](const Ran& ran) {
    return nlohmann::json::parse(ran.out)[0]["clips"][0]["facts"];
  };
  const auto closed = facts(stylize("--json"));
  EXPECT_EQ(closed["unchanged"], false);
  EXPECT_GE(closed["loop"]["rounds"], 2);
  EXPECT_LT(closed["loop"]["gap_before_cm"], 0.1);
  EXPECT_LT(closed["loop"]["spread_cm"], 0.5);
  EXPECT_EQ(closed["known"], 1);
  EXPECT_EQ(closed["seated"], 0);
  EXPECT_TRUE(facts(stylize("--json --loop off"))["loop"].is_null());
  const Ran same = run("stylize loop.bvh --style old=0 -o same.bvh");
  EXPECT_EQ(last_line(same.out), "  loop.bvh: unchanged");
  EXPECT_TRUE(read("same.bvh") == read("loop.bvh"));
}

TEST_F(StylizeLoop, each_motion_of_a_batch_has_its_line) {
  write_walk("in/a.bvh", 31);
  write_walk("in/b.bvh", 40);
  const Ran ran = must("stylize in --style old=1 -o out");
  EXPECT_TRUE(holds(ran.out, "\n  in/a.bvh: loop closed; "));
  EXPECT_TRUE(holds(ran.out, "\n  in/b.bvh: "));
}

TEST_F(StylizeLoop, info_tells_loops) {
  write_walk("loop.bvh", 31);
  write_walk("walk.bvh", 40);
  EXPECT_TRUE(holds(run("info loop.bvh").out, "1.03 s, a loop\n"));
  EXPECT_FALSE(holds(run("info walk.bvh").out, "a loop"));
  const auto loop = [&](const char* name) {
    return nlohmann::json::parse(run({"info", name, "--json"}).out)["clips"][0]["loop"];
  };
  EXPECT_EQ(loop("loop.bvh"), true);
  EXPECT_EQ(loop("walk.bvh"), false);
}

}  // namespace
}  // namespace panache::test
