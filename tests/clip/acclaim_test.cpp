// CMU's own formats: skeletons, motions, what is wrong with them, and that nothing of it hurts.

#include "clip/acclaim.h"

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

TEST_F(Acclaim, a_body_comes_out_in_its_places_and_is_recognised) {
  const Clip walk = test::walking_clip(20);
  test::AcclaimMaker maker(walk);
  const auto file = must(maker.asf(), maker.amc());
  ASSERT_TRUE(file);
  const Clip& clip = file->clip();
  ASSERT_EQ(clip.frames, 20);
  const Result<Rig> rig = Rig::create(clip);
  ASSERT_TRUE(rig.ok()) << rig.error().message;
  for (int f = 0; f < 20; f += 7) {
    const std::vector<Vec3> want = world_positions(walk, f), got = world_positions(clip, f);
    for (int j = 0; j < kHumanJoints; ++j) {
      // Six decimals of a degree and of a metre.
      const int joint = rig->joints()[j];
      ASSERT_GE(joint, 0) << human_joint_name(j);
      EXPECT_EQ(clip.skeleton.joints[static_cast<size_t>(joint)].name,
                maker.name(static_cast<size_t>(j)));
      EXPECT_LT(length(want[static_cast<size_t>(j)] - got[static_cast<size_t>(joint)]), 2e-5f);
    }
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
  float worst = 0;
  for (int f = 0; f < 300; f += 13) {
    const std::vector<Vec3> want = world_positions(walk, f), got = world_positions(file->clip(), f);
    for (size_t j = 0; j < walk.joints(); ++j) {
      for (size_t k = 0; k < file->clip().joints(); ++k) {
        if (file->clip().skeleton.joints[k].name != maker.name(j)) continue;
        worst = std::max(worst, length(want[j] - got[k]));
      }
    }
  }
  // Angles of six decimals over 15 units of 5.6 cm.
  std::printf("worst place %.1e of 5.6 cm\n", static_cast<double>(worst));
  EXPECT_LT(worst, 1e-4f);
  EXPECT_GT(worst, 0);
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

TEST_F(Acclaim, what_is_wrong_with_a_skeleton_is_said_with_its_place) {
  EXPECT_EQ(rejection(replaced(kAsf, ":version 1.10", "version 1.10"), kAmc),
            "05.asf:2:1: expected a section such as ':root', found 'version'");
  EXPECT_EQ(rejection(replaced(kAsf, "angle deg", "angle grad"), kAmc),
            "05.asf:5:9: expected deg or rad, found 'grad'");
  EXPECT_EQ(rejection(replaced(kAsf, "orientation 0", "rotation 0"), kAmc),
            "05.asf:10:4: expected order, axis, position or orientation, found 'rotation'");
  EXPECT_EQ(rejection(replaced(kAsf, "axis XYZ", "axis XYX"), kAmc),
            "05.asf:8:9: expected an order of axes such as XYZ, found 'XYX'");
  EXPECT_EQ(rejection(replaced(kAsf, "axis XYZ", "axis XYW"), kAmc),
            "05.asf:8:9: expected an order of axes such as XYZ, found 'XYW'");
  EXPECT_EQ(rejection(replaced(kAsf, "axis XYZ", "axis XY"), kAmc),
            "05.asf:8:9: expected an order of axes such as XYZ, found 'XY'");
  EXPECT_EQ(rejection(replaced(kAsf, "position 0 0 0", "position 0 0"), kAmc),
            "05.asf:9:16: expected a number for the position, found the end of the line");
  EXPECT_EQ(rejection(replaced(kAsf, "0 0 90  XYZ", "0 0 90  XYY"), kAmc),
            "05.asf:17:19: expected an order of axes such as XYZ, found 'XYY'");
  EXPECT_EQ(rejection(replaced(kAsf, "name arm", ""), kAmc),
            "05.asf:22:3: expected a bone with a name before this, found 'begin'");
  EXPECT_EQ(
      rejection(replaced(kAsf, "name arm", "name root"), kAmc),
      "05.asf:22:3: expected another name than 'root' for the bone before this, found 'begin'");
  EXPECT_EQ(
      rejection(replaced(kAsf, "length 2", "length 2e9"), kAmc),
      "05.asf:16:13: expected a number between -1e9 and 1e9 for the length of a bone, found '2e9'");
  EXPECT_EQ(rejection(replaced(kAsf, "length 2", "length 1e9\n direction 2 0 0"), kAmc),
            "05.asf:23:3: expected a shorter bone before this, found 'begin'");
  EXPECT_EQ(rejection(replaced(kAsf, "  end\n:hierarchy", ":hierarchy"), kAmc),
            "05.asf:29:1: expected 'end' of a bone, found ':hierarchy'");
  EXPECT_EQ(rejection(replaced(kAsf, "  end\n:hierarchy", "  end\n  bone\n:hierarchy"), kAmc),
            "05.asf:30:3: expected 'begin' or the next section, found 'bone'");
  EXPECT_EQ(rejection(replaced(kAsf, ":hierarchy\n  begin", ":hierarchy\n"), kAmc),
            "05.asf:32:5: expected 'begin', found 'root'");
  EXPECT_EQ(rejection(replaced(kAsf, "root arm", "trunk arm"), kAmc),
            "05.asf:32:5: expected 'root' or the name of a bone, found 'trunk'");
  EXPECT_EQ(rejection(std::string(kAsf).substr(0, std::string(kAsf).rfind("  end")), kAmc),
            "05.asf:34:1: expected 'end' of the hierarchy, found the end of the file");
  EXPECT_EQ(rejection(std::string(kAsf).substr(0, std::string(kAsf).find(":hierarchy")), kAmc),
            "05.asf: expected ':hierarchy', found the end of the file");
}

TEST_F(Acclaim, what_is_wrong_is_said_with_its_place) {
  EXPECT_EQ(rejection("", kAmc), "05.asf: expected ':root', found the end of the file");
  EXPECT_EQ(rejection(replaced(kAsf, "    arm hand\n", ""), kAmc),
            "05.asf: expected every bone below the root, found 1 that are not");
  EXPECT_EQ(rejection(replaced(kAsf, "root arm", "root leg"), kAmc),
            "05.asf:32:10: expected the name of a bone, found 'leg'");
  EXPECT_EQ(rejection(replaced(kAsf, "arm hand", "hand arm"), kAmc),
            "05.asf:33:10: expected a bone that has no parent yet, found 'arm'");
  EXPECT_EQ(rejection(replaced(kAsf, "dof rx rz", "dof rx l"), kAmc),
            "05.asf:18:12: expected degrees of freedom: tx, ty, tz, rx, ry or rz, found 'l'");
  EXPECT_EQ(rejection(replaced(kAsf, "length 2", "length long"), kAmc),
            "05.asf:16:13: expected a number for the length of a bone, found 'long'");
  EXPECT_EQ(rejection(replaced(kAsf, "name hand", "name arm"), kAmc),
            "05.asf:30:1: expected another name than 'arm' for the bone before this, found "
            "':hierarchy'");
  EXPECT_EQ(rejection(kAsf, replaced(kAmc, "arm 0 90", "arm 0")),
            "05_10.amc:6:6: expected a number for a degree of freedom of arm, found the end of the "
            "line");
  EXPECT_EQ(rejection(kAsf, replaced(kAmc, "arm 0 90", "arm 0 90 7")),
            "05_10.amc:6:10: expected the end of the line after 2 numbers of arm, found '7'");
  EXPECT_EQ(rejection(kAsf, replaced(kAmc, "arm 0 90", "tail 0 90")),
            "05_10.amc:6:1: expected the name of a bone of the .asf, found 'tail'");
  EXPECT_EQ(rejection(kAsf, replaced(kAmc, "2\nroot", "2 root")),
            "05_10.amc:8:3: expected the number of a frame on a line of its own, found 'root'");
  EXPECT_EQ(rejection(kAsf, ":DEGREES\n"),
            "05_10.amc:2:1: expected a frame: its number, then its bones, found the end of the "
            "file");
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

// A message or a clip that keeps its promises.
bool check_harmless(const std::string& amc, const std::string& path) {
  auto file = parse_amc(amc, path);
  if (file) {
    EXPECT_EQ(broken_promise((*file)->clip()), "") << amc;
  } else {
    EXPECT_NE(file.error().message.find(": expected "), std::string::npos) << file.error().message;
    EXPECT_NE(file.error().message.find(", found "), std::string::npos) << file.error().message;
    EXPECT_EQ(file.error().message.find('\n'), std::string::npos) << file.error().message;
  }
  return file.ok();
}

TEST_F(Acclaim, every_truncation_and_every_changed_byte_is_harmless) {
  put("05.asf", kAsf);
  const std::string amc = kAmc, asf = kAsf;
  for (size_t size = 0; size < amc.size(); ++size) {
    check_harmless(amc.substr(0, size), path("05_10.amc"));
  }
  int accepted = 0, rejected = 0;
  const auto spoil = [](std::string text, size_t i, char value) {
    text[i] = value ? value : static_cast<char>(text[i] ^ 1);
    return text;
  };
  for (const char value : {'\0', ' ', '\n', '9', '-', '#', ':', '\xff'}) {
    for (size_t i = 0; i < amc.size(); ++i) {
      ++(check_harmless(spoil(amc, i, value), path("05_10.amc")) ? accepted : rejected);
    }
    for (size_t i = 0; i < asf.size(); ++i) {
      put("05.asf", spoil(asf, i, value));
      ++(check_harmless(amc, path("05_10.amc")) ? accepted : rejected);
    }
  }
  for (size_t size = 0; size < asf.size(); ++size) {
    put("05.asf", asf.substr(0, size));
    check_harmless(amc, path("05_10.amc"));
  }
  EXPECT_GT(accepted, 500);
  EXPECT_GT(rejected, 500);
}

}  // namespace
}  // namespace panache
