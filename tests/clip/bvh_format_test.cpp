#include <cmath>

#include "fixtures.h"

namespace panache {
namespace {

// A skeleton whose joints do not stand depth first.
Clip breadth_first_clip() {
  Clip clip;
  clip.skeleton.joints.resize(5);
  auto& joints = clip.skeleton.joints;
  joints[0] = {"hips", -1, {0, 0.9f, 0}, {}, true, true, {}, ""};
  joints[1] = {"left leg", 0, {0.1f, 0, 0}, {}, true, false, {}, ""};
  joints[2] = {"right leg", 0, {-0.1f, 0, 0}, {}, true, false, {{0, -0.4f, 0}, {0, -0.4f, 0.1f}},
               ""};
  joints[3] = {"left foot", 1, {0, -0.4f, 0}, {}, true, true, {{0, 0, 0.2f}}, ""};
  joints[4] = {"prop", -1, {}, {}, true, true, {}, ""};
  clip.frame_time = 1.0 / 30;
  clip.resize(40);
  for (int i = 0; i < clip.frames; ++i) {
    const Pose pose = clip.pose(i);
    for (size_t j = 0; j < 5; ++j) {
      const float phase = static_cast<float>(j) + 0.2f * static_cast<float>(i);
      pose.rotations[j] = axis_angle(Vec3{0.6f, 0, 0.8f}, phase);
      pose.translations[j] = joints[j].can_translate ? Vec3{phase, 1, -phase} : joints[j].offset;
    }
  }
  return clip;
}

TEST(BvhFormat, what_is_written_reads_back_depth_first) {
  const Clip clip = breadth_first_clip();
  const auto file = must_parse(format_bvh(clip));
  ASSERT_TRUE(file);
  const Clip& back = file->clip();
  const size_t order[] = {0, 1, 3, 2, 4};
  const int parents[] = {-1, 0, 1, 0, -1};
  ASSERT_EQ(back.joints(), 5u);
  ASSERT_EQ(back.frames, clip.frames);
  EXPECT_NEAR(back.frame_time, clip.frame_time, 1e-9);
  for (size_t k = 0; k < 5; ++k) {
    const Joint &a = clip.skeleton.joints[order[k]], &b = back.skeleton.joints[k];
    EXPECT_EQ(a.name, b.name);
    EXPECT_EQ(b.parent, parents[k]);
    EXPECT_EQ(a.offset, b.offset);
    EXPECT_EQ(a.ends, b.ends);
    EXPECT_EQ(a.can_translate, b.can_translate);
  }
  for (int i = 0; i < clip.frames; ++i) {
    for (size_t k = 0; k < 5; ++k) {
      // Half of the sixth decimal thrice, in radians, and floats.
      EXPECT_LT(angle_between(back.pose(i).rotations[k], clip.pose(i).rotations[order[k]]), 1e-6);
      EXPECT_LT(length(back.pose(i).translations[k] - clip.pose(i).translations[order[k]]), 2e-6f);
    }
  }
}

TEST(BvhFormat, reads_as_people_expect) {
  Clip clip = breadth_first_clip();
  clip.skeleton.joints.resize(3);
  clip.frames = 0;
  clip.resize(1);
  clip.rotations = {rotation_y(0.5f), {}, {}};
  clip.translations = {{1, 2, 3}, {}, {}};
  EXPECT_EQ(format_bvh(clip),
            "HIERARCHY\n"
            "ROOT hips\n"
            "{\n"
            "  OFFSET 0.000000 0.900000 0.000000\n"
            "  CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation\n"
            "  JOINT left leg\n"
            "  {\n"
            "    OFFSET 0.100000 0.000000 0.000000\n"
            "    CHANNELS 3 Zrotation Xrotation Yrotation\n"
            "  }\n"
            "  JOINT right leg\n"
            "  {\n"
            "    OFFSET -0.100000 0.000000 0.000000\n"
            "    CHANNELS 3 Zrotation Xrotation Yrotation\n"
            "    End Site\n"
            "    {\n"
            "      OFFSET 0.000000 -0.400000 0.000000\n"
            "    }\n"
            "    End Site\n"
            "    {\n"
            "      OFFSET 0.000000 -0.400000 0.100000\n"
            "    }\n"
            "  }\n"
            "}\n"
            "MOTION\n"
            "Frames: 1\n"
            "Frame Time: 0.033333333\n"
            "1.000000 2.000000 3.000000 0.000000 0.000000 28.647890 0.000000 0.000000 0.000000 "
            "0.000000 0.000000 0.000000\n");
}

TEST(BvhFormat, names_that_would_break_the_file_are_mended) {
  Clip clip = breadth_first_clip();
  clip.skeleton.joints[0].name = "";
  clip.skeleton.joints[1].name = "a\nb";
  clip.skeleton.joints[2].name = "leg {";
  const auto file = must_parse(format_bvh(clip));
  ASSERT_TRUE(file);
  EXPECT_EQ(file->clip().skeleton.joints[0].name, "joint0");
  EXPECT_EQ(file->clip().skeleton.joints[1].name, "a_b");
  EXPECT_EQ(file->clip().skeleton.joints[3].name, "leg _");
}

TEST(BvhFormat, a_turn_goes_on_without_a_wrap) {
  Clip clip;
  clip.skeleton.joints.resize(1);
  clip.skeleton.joints[0].name = "hips";
  clip.resize(100);
  for (int i = 0; i < 100; ++i)
    clip.pose(i).rotations[0] = rotation_y(0.2f * static_cast<float>(i));
  const std::string text = format_bvh(clip);
  const double turn = 99 * 0.2 * 180 / 3.14159265358979;  // Three whole turns and more.
  EXPECT_NEAR(std::stod(text.substr(text.find_last_of(' '))), turn, 1e-3);
}

}  // namespace
}  // namespace panache
