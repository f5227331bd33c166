// CMU's own formats: skeletons, motions, what is wrong with them, and that nothing of it hurts.

#include "clip/acclaim.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "clip/clip.h"
#include "clip/make_acclaim.h"
#include "clip/motion_format.h"
#include "fixtures.h"
#include "make_clip.h"
#include "rig/rig.h"
#include "temporary_folder.h"

namespace panache {
namespace {

using test::world_positions;

// Two bones below the root; the second begins where the first ends.
constexpr const char* kAsf = R"(# a comment
:version 1.10
:units
  length 0.45
  angle deg
:root
   order TX TY TZ RX RY RZ
   axis XYZ
   position 0 0 0
   orientation 0 0 0
:bonedata
  begin
     id 1
     name arm
     direction 1 0 0
     length 2
     axis 0 0 90  XYZ
    dof rx rz
    limits (-160.0 20.0)
           (-70 70)
  end
  begin
     id 2
     name hand
     direction 0 1 0
     length 0.5
     axis 0 0 0  XYZ
    dof rx ry rz
  end
:hierarchy
  begin
    root arm
    arm hand
  end
)";
constexpr const char* kAmc = R"(#!OML:ASF nowhere
:FULLY-SPECIFIED
:DEGREES
1
root 1 2 3 0 0 0
arm 0 90
hand 0 0 0
2
root 1 2 4 0 90 0
arm 90 0
hand 30 40 50
)";

class Acclaim : public testing::Test {
 protected:
  void put(const std::string& name, const std::string& text) {
    ASSERT_TRUE(write_file(folder_.path() + name, text, true).ok());
  }
  std::string path(const std::string& name) const { return folder_.path() + name; }
  std::unique_ptr<MotionFile> must(const std::string& asf, const std::string& amc) {
    put("05.asf", asf);
    auto file = parse_amc(amc, path("05_10.amc"));
    EXPECT_TRUE(file.ok()) << file.error().message;
    return file ? *std::move(file) : nullptr;
  }
  // The message without the folder.
  std::string rejection(const std::string& asf, const std::string& amc) {
    put("05.asf", asf);
    auto file = parse_amc(amc, path("05_10.amc"));
    if (file) return "(accepted)";
    EXPECT_TRUE(file.error().message.starts_with(folder_.path())) << file.error().message;
    return file.error().message.substr(folder_.path().size());
  }
  static Quat world_turn(const Clip& clip, size_t joint) {
    std::vector<Quat> out(clip.joints());
    std::vector<Vec3> positions(clip.joints());
    world_pose(clip.skeleton, clip.pose(0), {out, positions});
    return out[joint];
  }

  test::TemporaryFolder folder_;
};

TEST_F(Acclaim, bones_turn_about_the_ends_of_those_above_in_axes_of_their_own) {
  const auto file = must(kAsf, kAmc);
  ASSERT_TRUE(file);
  const Clip& clip = file->clip();
  ASSERT_EQ(clip.joints(), 3u);
  EXPECT_EQ(clip.frames, 2);
  EXPECT_NEAR(clip.frame_time, 1.0 / 120, 1e-9);
  EXPECT_EQ(clip.skeleton.joints[1].name, "arm");
  EXPECT_EQ(clip.skeleton.joints[2].offset, (Vec3{2, 0, 0}));
  EXPECT_EQ(clip.skeleton.joints[2].ends, std::vector<Vec3>{(Vec3{0, 0.5f, 0})});
  // The root at 1 2 3; the arm a quarter turn about z, which its axis leaves alone: it points up.
  EXPECT_LT(length(world_positions(clip, 0)[2] - Vec3{1, 4, 3}), 1e-5f);
  // The root a quarter turn about y: x becomes -z. The arm's own x is the skeleton's y, about which
  // a quarter turn brings x to -z; after the root's, to -x.
  EXPECT_LT(length(world_positions(clip, 1)[1] - Vec3{1, 2, 4}), 1e-5f);
  EXPECT_LT(length(world_positions(clip, 1)[2] - Vec3{-1, 2, 4}), 1e-5f);
  // The hand's: x first, then y, then z.
  constexpr double kDegree = 3.14159265358979323846 / 180;
  const Quatd hand = axis_angle(Vec3d{0, 0, 1}, 50 * kDegree) *
                     axis_angle(Vec3d{0, 1, 0}, 40 * kDegree) *
                     axis_angle(Vec3d{1, 0, 0}, 30 * kDegree);
  EXPECT_LT(angle_between(clip.pose(1).rotations[2], hand.as<float>()), 1e-6);
}

// The format itself says none.
TEST_F(Acclaim, a_rate_that_is_given_takes_the_place_of_120_frames_a_second) {
  put("05.asf", kAsf);
  for (const double fps : {60.0, 24.0, 7.5}) {
    const auto file = parse_amc(kAmc, path("05_10.amc"), {.fps = fps});
    ASSERT_TRUE(file.ok()) << file.error().message;
    EXPECT_NEAR((*file)->clip().frame_time, 1 / fps, 1e-9);
    EXPECT_EQ((*file)->clip().frames, 2);
  }
}

// How far the joints are at most from where the clip has them that was written.
float worst_of(const Clip& walk, const test::AcclaimMaker& maker, const Clip& read) {
  float worst = 0;
  for (int f = 0; f < walk.frames; f += 7) {
    const std::vector<Vec3> want = world_positions(walk, f), got = world_positions(read, f);
    for (size_t j = 0; j < walk.joints(); ++j) {
      const auto same = std::ranges::find(read.skeleton.joints, maker.name(j), &Joint::name);
      if (same == read.skeleton.joints.end()) return INFINITY;
      worst = std::max(worst, length(want[j] - got[same - read.skeleton.joints.begin()]));
    }
  }
  return worst;
}

TEST_F(Acclaim, a_body_comes_out_in_its_places_and_is_recognised) {
  const Clip walk = test::walking_clip(20);
  test::AcclaimMaker maker(walk);
  const auto file = must(maker.asf(), maker.amc());
  ASSERT_TRUE(file);
  ASSERT_EQ(file->clip().frames, 20);
  EXPECT_LT(worst_of(walk, maker, file->clip()), 2e-5f);  // Six decimals of a degree and a metre.
  const Result<Rig> rig = Rig::create(file->clip());
  ASSERT_TRUE(rig.ok()) << rig.error().message;
  for (size_t j = 0; j < kHumanJoints; ++j) {
    ASSERT_GE(rig->joints()[j], 0) << human_joint_name(static_cast<int>(j));
    EXPECT_EQ(file->clip().skeleton.joints[rig->joints()[j]].name, maker.name(j));
  }
}

TEST_F(Acclaim, real_motion_of_cmu_comes_out_in_its_places) {
  const char* data = std::getenv("PANACHE_DATA");
  if (!data) GTEST_SKIP() << "PANACHE_DATA is not set: no real motion to read";
  const auto bvh = read_motion(std::string(data) + "/formats/cmu/05_02.bvh");
  if (!bvh) GTEST_SKIP() << bvh.error().message;
  Clip walk = (*bvh)->clip();
  walk.resize(300);
  test::AcclaimMaker maker(walk);
  const auto file = must(maker.asf(), maker.amc());
  ASSERT_TRUE(file);
  // Angles of six decimals over 15 units of 5.6 cm.
  EXPECT_LT(worst_of(walk, maker, file->clip()), 1e-4f);
}

TEST_F(Acclaim, its_skeleton_is_found_as_cmu_names_it_or_alone) {
  for (const char* name : {"05.asf", "05_10.asf", "other.asf"}) {
    put(name, kAsf);
    EXPECT_TRUE(parse_amc(kAmc, path("05_10.amc")).ok()) << name;
    std::filesystem::remove(path(name));
  }
  EXPECT_EQ(parse_amc(kAmc, path("05_10.amc")).error().message,
            path("05_10.amc") + ": expected its skeleton beside it as 05.asf, found no .asf");
  put("a.asf", kAsf);
  put("b.asf", kAsf);
  EXPECT_EQ(parse_amc(kAmc, path("05_10.amc")).error().message,
            path("05_10.amc") + ": expected its skeleton beside it as 05.asf, found 2 others");
}

TEST_F(Acclaim, radians_and_what_a_frame_leaves_out) {
  const std::string amc = ":RADIANS\n1\narm 0 1.5707963267948966\n2\nroot 0 0 0 0 0 0\n";
  const auto file = must(kAsf, amc);
  ASSERT_TRUE(file);
  for (int f = 0; f < 2; ++f)
    EXPECT_LT(length(world_positions(file->clip(), f)[2] - Vec3{0, 2, 0}), 1e-5f);
}

TEST_F(Acclaim, angles_of_the_skeleton_may_be_radians) {
  std::string asf = replaced(kAsf, "angle deg", "ANGLE RAD");
  asf = replaced(asf, "axis 0 0 90", "axis 0 0 1.5707963267948966");
  asf = replaced(asf, "orientation 0 0 0", "orientation 0 0 1.5707963267948966");
  // The motion's are as well unless it says otherwise.
  for (const auto& [head, quarter] : {std::pair{"", "1.5707963267948966"},
                                      {":RADIANS\n", "1.5707963267948966"},
                                      {":DEGREES\n", "90"}}) {
    const auto file =
        must(asf, std::string(head) + "1\nroot 0 0 0 " + quarter + " 0 0\narm 0 " + quarter + "\n");
    ASSERT_TRUE(file);
    // The arm points up, and the root turns about its own x, the skeleton's y.
    EXPECT_LT(length(world_positions(file->clip(), 0)[2] - Vec3{0, 2, 0}), 1e-5f) << head;
    // The hand would point to -x, which the root turns to +z.
    const Quat hand = world_turn(file->clip(), 2);
    EXPECT_LT(length(rotate(hand, Vec3{0, 1, 0}) - Vec3{0, 0, 1}), 1e-5f) << head;
  }
}

TEST_F(Acclaim, what_is_wrong_is_said_with_its_place) {
  const std::string asf = kAsf, amc = kAmc;
  const struct {
    std::string from, to, message;
  } skeletons[] = {
      {":version 1.10", "version 1.10",
       ":2:1: expected a section such as ':root', found 'version'"},
      {"angle deg", "angle grad", ":5:9: expected deg or rad, found 'grad'"},
      {"orientation 0", "rotation 0",
       ":10:4: expected order, axis, position or orientation, found 'rotation'"},
      {"axis XYZ", "axis XYX", ":8:9: expected an order of axes such as XYZ, found 'XYX'"},
      {"axis XYZ", "axis XYW", ":8:9: expected an order of axes such as XYZ, found 'XYW'"},
      {"axis XYZ", "axis XY", ":8:9: expected an order of axes such as XYZ, found 'XY'"},
      {"position 0 0 0", "position 0 0",
       ":9:16: expected a number for the position, found the end of the line"},
      {"0 0 90  XYZ", "0 0 90  XYY", ":17:19: expected an order of axes such as XYZ, found 'XYY'"},
      {"name arm", "", ":22:3: expected a bone with a name before this, found 'begin'"},
      {"name arm", "name root",
       ":22:3: expected another name than 'root' for the bone before this, found 'begin'"},
      {"name hand", "name arm",
       ":30:1: expected another name than 'arm' for the bone before this, found ':hierarchy'"},
      {"length 2", "length long",
       ":16:13: expected a number for the length of a bone, found 'long'"},
      {"length 2", "length 2e9",
       ":16:13: expected a number between -1e9 and 1e9 for the length of a bone, found '2e9'"},
      {"length 2", "length 1e9\n direction 2 0 0",
       ":23:3: expected a shorter bone before this, found 'begin'"},
      {"dof rx rz", "dof rx l",
       ":18:12: expected degrees of freedom: tx, ty, tz, rx, ry or rz, found 'l'"},
      {"  end\n:hierarchy", ":hierarchy", ":29:1: expected 'end' of a bone, found ':hierarchy'"},
      {"  end\n:hierarchy", "  end\n  bone\n:hierarchy",
       ":30:3: expected 'begin' or the next section, found 'bone'"},
      {":hierarchy\n  begin", ":hierarchy\n", ":32:5: expected 'begin', found 'root'"},
      {"root arm", "trunk arm", ":32:5: expected 'root' or the name of a bone, found 'trunk'"},
      {"root arm", "root leg", ":32:10: expected the name of a bone, found 'leg'"},
      {"arm hand", "hand arm", ":33:10: expected a bone that has no parent yet, found 'arm'"},
      {"    arm hand\n", "", ": expected every bone below the root, found 1 that are not"},
      {"arm hand\n  end\n", "arm hand\n",
       ":34:1: expected 'end' of the hierarchy, found the end of the file"},
      {asf.substr(asf.find(":hierarchy")), "",
       ": expected ':hierarchy', found the end of the file"},
      {asf, "", ": expected ':root', found the end of the file"}};
  for (const auto& [from, to, message] : skeletons) {
    EXPECT_EQ(rejection(replaced(asf, from, to), amc), "05.asf" + message);
  }
  const struct {
    std::string from, to, message;
  } motions[] = {
      {"arm 0 90", "arm 0",
       ":6:6: expected a number for a degree of freedom of arm, found the end of the line"},
      {"arm 0 90", "arm 0 90 7",
       ":6:10: expected the end of the line after 2 numbers of arm, found '7'"},
      {"arm 0 90", "tail 0 90", ":6:1: expected the name of a bone of the .asf, found 'tail'"},
      {"2\nroot", "2 root",
       ":8:3: expected the number of a frame on a line of its own, found 'root'"},
      {amc.substr(amc.find("1\nroot")), "",
       ":4:1: expected a frame: its number, then its bones, found the end of the file"}};
  for (const auto& [from, to, message] : motions) {
    EXPECT_EQ(rejection(asf, replaced(amc, from, to)), "05_10.amc" + message);
  }
}

// A skeleton of so many bones below the root, each below the one before or all below the root.
std::string asf_of(int bones, bool chain) {
  std::string list, tree;
  for (int i = 0; i < bones; ++i) {
    const std::string name = "b" + std::to_string(i);
    list += "begin\nname " + name + "\nend\n";
    tree += (chain && i > 0 ? "b" + std::to_string(i - 1) : "root") + " " + name + "\n";
  }
  return ":root\norder TX TY TZ RX RY RZ\n:bonedata\n" + list + ":hierarchy\nbegin\n" + tree +
         "end\n";
}

TEST_F(Acclaim, limits_of_bones_and_nesting) {
  const std::string amc = ":DEGREES\n1\nroot 0 0 0 0 0 0\n";
  EXPECT_EQ(rejection(asf_of(9'999, false), amc), "(accepted)");
  EXPECT_EQ(rejection(asf_of(10'001, false), amc),
            "05.asf:30005:1: expected at most 10000 bones, found 'name'");
  // The root is one of them.
  EXPECT_EQ(rejection(asf_of(999, true), amc), "(accepted)");
  EXPECT_EQ(rejection(asf_of(1'000, true), amc),
            "05.asf: expected at most 1000 bones one below the other, found more");
}

TEST_F(Acclaim, a_small_file_makes_no_long_motion_of_many_bones) {
  // 10,000 joints with the root: 100 frames in a file of less than 250 KB.
  std::string amc = ":DEGREES\n";
  for (int i = 1; i <= 100; ++i) amc += std::to_string(i) + "\n";
  EXPECT_EQ(rejection(asf_of(9'999, false), amc), "(accepted)");
  EXPECT_EQ(rejection(asf_of(9'999, false), amc + "101\n"),
            "05_10.amc:102:1: expected at most 100 frames of 10000 joints in a file of this size, "
            "found '101'");
}

TEST_F(Acclaim, every_truncation_and_every_changed_byte_is_harmless) {
  const std::string amc = kAmc, asf = kAsf;
  int accepted = 0, rejected = 0;
  const auto check = [&](const std::string& skeleton, const std::string& motion) {
    put("05.asf", skeleton);
    const auto file = parse_amc(motion, path("05_10.amc"));
    ++(file ? accepted : rejected);
    if (file) {
      EXPECT_EQ(broken_promise((*file)->clip()), "") << skeleton << motion;
    } else {
      expect_whole_message(file.error(), folder_.path());
    }
  };
  for (size_t size = 0; size < amc.size(); ++size) check(asf, amc.substr(0, size));
  for (size_t size = 0; size < asf.size(); ++size) check(asf.substr(0, size), amc);
  for (const int value : std::initializer_list<int>{-1, ' ', '\n', '9', '-', '#', ':', 0xff}) {
    for (size_t i = 0; i < amc.size(); ++i) check(asf, with_byte(amc, i, value));
    for (size_t i = 0; i < asf.size(); ++i) check(with_byte(asf, i, value), amc);
  }
  EXPECT_GT(accepted, 500);
  EXPECT_GT(rejected, 500);
}

}  // namespace
}  // namespace panache
