#include "clip/bvh.h"

#include "clip/euler.h"
#include "fixtures.h"

namespace panache {
namespace {

void expect_same_clip(const Clip& a, const Clip& b) {
  ASSERT_EQ(a.joints(), b.joints());
  for (size_t j = 0; j < a.joints(); ++j) {
    const Joint &x = a.skeleton.joints[j], &y = b.skeleton.joints[j];
    EXPECT_EQ(x.name, y.name);
    EXPECT_EQ(x.parent, y.parent);
    EXPECT_EQ(x.offset, y.offset);
    EXPECT_EQ(x.ends, y.ends);
    EXPECT_EQ(x.can_rotate, y.can_rotate);
    EXPECT_EQ(x.can_translate, y.can_translate);
  }
  EXPECT_EQ(a.frame_time, b.frame_time);
  EXPECT_EQ(a.frames, b.frames);
  EXPECT_EQ(a.rotations, b.rotations);
  EXPECT_EQ(a.translations, b.translations);
}

TEST(BvhReading, hierarchy_rate_and_poses_are_the_files) {
  const auto file = must_parse(read_fixture("plain.bvh"));
  ASSERT_TRUE(file);
  const Clip& clip = file->clip();
  ASSERT_EQ(clip.joints(), 3u);
  EXPECT_EQ(clip.skeleton.joints[0].name, "Hips");
  EXPECT_EQ(clip.skeleton.joints[1].name, "LeftUpLeg");
  EXPECT_EQ(clip.skeleton.joints[2].parent, 0);
  EXPECT_EQ(clip.skeleton.joints[2].offset, (Vec3{0, 12, -1.5f}));
  EXPECT_EQ(clip.skeleton.joints[2].ends, (std::vector<Vec3>{{0, 20, 0}}));
  EXPECT_TRUE(clip.skeleton.joints[0].can_translate);
  EXPECT_FALSE(clip.skeleton.joints[1].can_translate);
  EXPECT_EQ(clip.frame_time, 0.033333);
  EXPECT_EQ(clip.frames, 3);
  EXPECT_EQ(clip.pose(1).translations[0], (Vec3{0.2f, 93.1f, -4.1f}));
  EXPECT_EQ(clip.pose(1).translations[1], (Vec3{9.1f, -10, 0}));
  EXPECT_EQ(clip.pose(1).rotations[2], euler_to_quat({3, {2, 1, 0}}, {5, 89, 7.5}).as<float>());
  EXPECT_EQ(broken_promise(clip), "");
}

TEST(BvhReading, odd_but_honest_files_are_read) {
  const auto file = must_parse(read_fixture("odd.bvh"));
  ASSERT_TRUE(file);
  const Clip& clip = file->clip();
  const auto& joints = clip.skeleton.joints;
  ASSERT_EQ(joints.size(), 4u);
  EXPECT_EQ(joints[0].name, "My Rig:Hips");
  EXPECT_EQ(joints[1].name, "left: upper arm");
  EXPECT_EQ(joints[2].name, "Hand");
  EXPECT_EQ(joints[3].name, "Hand");
  EXPECT_EQ(joints[1].ends, (std::vector<Vec3>{{1, 1, 1}, {2, 2, 2}}));
  EXPECT_EQ(joints[1].offset, (Vec3{-1, 2, 0.3f}));
  EXPECT_FALSE(joints[1].can_rotate || joints[1].can_translate);
  EXPECT_EQ(joints[2].parent, 1);
  EXPECT_EQ(joints[3].parent, 0);
  EXPECT_EQ(clip.frame_time, 0.04);
  ASSERT_EQ(clip.frames, 2);
  // Yrotation 1.5, Zposition -2: the other axes of the position stay at the OFFSET.
  EXPECT_EQ(clip.pose(0).translations[0], (Vec3{1, 2, -2}));
  EXPECT_EQ(clip.pose(0).rotations[0], euler_to_quat({1, {1, 0, 0}}, {1.5}).as<float>());
  EXPECT_EQ(clip.pose(0).translations[1], joints[1].offset);
  EXPECT_EQ(clip.pose(0).rotations[1], Quat{});
  EXPECT_EQ(clip.pose(0).translations[2], (Vec3{10, 20, -9.23872e-7f}));
  EXPECT_EQ(clip.pose(0).rotations[2], euler_to_quat({2, {0, 2, 0}}, {10, 20}).as<float>());
  EXPECT_EQ(clip.pose(1).rotations[3], euler_to_quat({3, {1, 0, 2}}, {30, 90, 50}).as<float>());
  EXPECT_EQ(broken_promise(clip), "");
}

TEST(BvhReading, channels_of_a_position_may_come_in_any_order) {
  for (const std::string order : {"XYZ", "XZY", "YXZ", "YZX", "ZXY", "ZYX"}) {
    std::string channels, numbers;
    for (const char axis : order) {
      channels += std::string(" ") + axis + "position";
      numbers += std::string(1, static_cast<char>('1' + (axis - 'X'))) + " ";
    }
    const auto file = must_parse("HIERARCHY\nROOT a\n{\nOFFSET 7 8 9\nCHANNELS 3" + channels +
                                 "\n}\nMOTION\nFrames: 1\nFrame Time: 0.1\n" + numbers + "\n");
    ASSERT_TRUE(file);
    EXPECT_EQ(file->clip().translations[0], (Vec3{1, 2, 3})) << order;
  }
}

TEST(BvhReading, several_roots_are_several_trees) {
  const auto file = must_parse(read_fixture("two_roots.bvh"));
  ASSERT_TRUE(file);
  const auto& joints = file->clip().skeleton.joints;
  ASSERT_EQ(joints.size(), 2u);
  EXPECT_EQ(joints[0].parent, -1);
  EXPECT_EQ(joints[1].parent, -1);
  EXPECT_EQ(file->clip().pose(1).translations[0], (Vec3{2, 3, 1.01f}));
  EXPECT_EQ(file->clip().pose(1).translations[1], (Vec3{0, 0.5f, 0}));
}

TEST(BvhReading, line_ends_spaces_and_byte_order_marks_change_nothing) {
  for (const char* fixture : kBvhFixtures) {
    const std::string text = read_fixture(fixture);
    const auto plain = must_parse(text);
    ASSERT_TRUE(plain);
    const std::string variants[] = {replaced_all(text, '\n', "\r\n"),
                                    replaced_all(text, '\n', "\r"),
                                    replaced_all(text, '\n', " \t\n\n"),
                                    replaced_all(text, '\n', "\r\r\n"),
                                    "\xef\xbb\xbf" + text,
                                    text.substr(0, text.find_last_not_of("\r\n ") + 1),
                                    "\n \n" + text + "\n \n"};
    for (const std::string& variant : variants) {
      const auto same = must_parse(variant);
      ASSERT_TRUE(same);
      expect_same_clip(same->clip(), plain->clip());
    }
  }
}

TEST(BvhReading, all_rows_are_read_and_a_wrong_count_is_noted_as_in_blender) {
  using Notes = std::vector<std::string>;
  EXPECT_EQ(must_parse(read_fixture("plain.bvh"))->notes(), Notes{});
  for (const char* count : {"0", "1", "2", "4", "1000000000000", "99999999999999999999999999"}) {
    const auto file = must_parse(
        replaced(read_fixture("plain.bvh"), "Frames: 3", std::string("Frames: ") + count));
    ASSERT_TRUE(file);
    EXPECT_EQ(file->clip().frames, 3);
    EXPECT_EQ(broken_promise(file->clip()), "");
    const bool short_file = count[0] > '3' || count[1] != '\0';
    EXPECT_EQ(file->notes(),
              Notes{std::string("test.bvh:26:9: expected a count of 3, that of the complete rows "
                                "that follow, found '") +
                    count + "'; all of them are read" +
                    (short_file ? ", and the file may be cut short" : "")});
  }
}

TEST(BvhReading, a_last_row_that_the_end_of_the_file_cuts_is_left_out_and_noted) {
  using Notes = std::vector<std::string>;
  const std::string head =
      "HIERARCHY\nROOT a\n{\nOFFSET 0 0 0\nCHANNELS 3 Xrotation Yrotation Zposition\n}\nMOTION\n"
      "Frames: 2\nFrame Time: 0.1\n1 2 3\n4 5 6\n";
  // What is there of the row, where the fault is, and how the message names what is there.
  const struct {
    std::string row, position, found;
  } cases[] = {{"7", "12:2", "channel 2 of 3 in the last row, found the end of the file"},
               {"7 8", "12:4", "channel 3 of 3 in the last row, found the end of the file"},
               {"7 8\n", "12:4", "channel 3 of 3 in the last row, found the end of the line"},
               {"7 8 \r\n\n ", "12:5", "channel 3 of 3 in the last row, found the end of the line"},
               {"7 8 -", "12:5", "channel 3 of 3 in the last row, found '-'"},
               {"7 8.5e", "12:3", "channel 2 of 3 in the last row, found '8.5e'"},
               {"-", "12:1", "channel 1 of 3 in the last row, found '-'"}};
  for (const auto& one : cases) {
    const auto file = must_parse(head + one.row);
    ASSERT_TRUE(file);
    EXPECT_EQ(file->clip().frames, 2);
    EXPECT_EQ(file->notes(), Notes{"test.bvh:" + one.position + ": expected " + one.found +
                                   "; this row is left out"});
  }
  // Announced, so that the count is wrong, too.
  const auto file = must_parse(replaced(head, "Frames: 2", "Frames: 3") + "7 8");
  ASSERT_TRUE(file);
  EXPECT_EQ(file->notes().size(), 2u);
  // A row that others follow is no end of a file.
  for (const char* row : {"7 8\n9 10 11\n", "7 8 x", "7 8 1e400", "x"}) {
    EXPECT_NE(rejection(head + row), "(accepted)") << row;
  }
}

TEST(BvhReading, a_rate_that_is_given_takes_the_place_of_whatever_the_file_says) {
  const std::string plain = read_fixture("plain.bvh");
  const ReadOptions at_50 = {.fps = 50};
  const std::string right = replaced(plain, "0.033333\n", "0.020000000\n");
  for (const char* line : {"Frame Time: 0.033333\n", "Frame Time: 0\n", "Frame Time: -1 \n",
                           "Frame Time: nan\n", "Frame Time:\n", "Frame Time: 1e-12\n", ""}) {
    const std::string text = replaced(plain, "Frame Time: 0.033333\n", line);
    const auto file = parse_bvh(text, "walk.bvh", at_50);
    ASSERT_TRUE(file.ok()) << file.error().message;
    EXPECT_EQ((*file)->clip().frame_time, 0.02);
    EXPECT_EQ((*file)->clip().frames, 3);
    // All that is written has the rate: the file as it is, and a changed one.
    EXPECT_EQ(replaced_all((*file)->encode({}, EditMode::replace), ' ', ""),
              replaced_all(right, ' ', ""));
    Clip clip = (*file)->clip();
    clip.resize(2);
    EXPECT_EQ(must_parse((*file)->encode(clip, same_frames(2)))->clip().frame_time, 0.02);
  }
  // Other line ends, and a rate that no decimal number is.
  const auto file = parse_bvh(replaced_all(plain, '\n', "\r\n"), "walk.bvh", {.fps = 120});
  ASSERT_TRUE(file.ok()) << file.error().message;
  EXPECT_NEAR((*file)->clip().frame_time, 1.0 / 120, 5e-10);
}

TEST(BvhReading, depth_and_joint_count_may_reach_their_limits) {
  for (const bool deep : {true, false}) {
    const int count = deep ? kBvhMaxDepth : kBvhMaxJoints;
    std::string text = "HIERARCHY\n", numbers;
    for (int i = 0; i < count; ++i) {
      text += "ROOT a\n{\nOFFSET 0 0 0\nCHANNELS 1 Xrotation\n";
      if (!deep) text += "}\n";
      numbers += "1 ";
    }
    for (int i = 0; deep && i < count; ++i) text += "}\n";
    text += "MOTION\nFrames: 1\nFrame Time: 1\n" + numbers;
    const auto file = must_parse(text);
    ASSERT_TRUE(file);
    EXPECT_EQ(file->clip().joints(), static_cast<size_t>(count));
    EXPECT_EQ(broken_promise(file->clip()), "");
  }
}

}  // namespace
}  // namespace panache
