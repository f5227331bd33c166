#include "fixtures.h"

namespace panache {
namespace {

// A file of one joint, in pieces to be spoilt one by one.
struct Pieces {
  std::string head = "HIERARCHY\n";
  std::string name = "ROOT Hips\n{\n";                                    // Lines 2 and 3.
  std::string offset = "  OFFSET 0 1 0\n";                                // Line 4.
  std::string channels = "  CHANNELS 3 Xrotation Yrotation Zposition\n";  // Line 5.
  std::string end = "  End Site\n  {\n    OFFSET 0 1 0\n  }\n";           // Lines 6 to 9.
  std::string close = "}\n";                                              // Line 10.
  std::string motion = "MOTION\n";                                        // Line 11.
  std::string count = "Frames: 2\n";                                      // Line 12.
  std::string time = "Frame Time: 0.04\n";                                // Line 13.
  std::string frames = "1 2 3\n4 5 6\n";                                  // Lines 14 and 15.

  std::string rejection() const {
    return panache::rejection(head + name + offset + channels + end + close + motion + count +
                              time + frames);
  }
};

TEST(BvhErrors, the_pieces_together_are_a_file) { EXPECT_EQ(Pieces().rejection(), "(accepted)"); }

TEST(BvhErrors, a_file_that_is_no_bvh) {
  EXPECT_EQ(rejection(""), "walk.bvh:1:1: expected 'HIERARCHY', found the end of the file");
  EXPECT_EQ(rejection(" \n\n"), "walk.bvh:3:1: expected 'HIERARCHY', found the end of the file");
  EXPECT_EQ(rejection(std::string("\x89PNG\r\n\x1a\n\0\0", 10)),
            "walk.bvh:1:1: expected 'HIERARCHY', found '\\x89PNG'");
  EXPECT_EQ(rejection(std::string("\0\0\0\0", 4)),
            "walk.bvh:1:1: expected 'HIERARCHY', found '\\x00\\x00\\x00\\x00'");
  EXPECT_EQ(rejection(std::string(1000, 'x')),
            "walk.bvh:1:1: expected 'HIERARCHY', found '" + std::string(40, 'x') + "...'");
}

TEST(BvhErrors, a_truncated_hierarchy) {
  EXPECT_EQ(rejection("HIERARCHY"), "walk.bvh:1:10: expected 'ROOT', found the end of the file");
  EXPECT_EQ(rejection("HIERARCHY\nROOT Hips\n{\n  OFF"),
            "walk.bvh:4:3: expected 'OFFSET' of joint 'Hips', found 'OFF'");
  EXPECT_EQ(
      rejection("HIERARCHY\nROOT Hips\n{\nOFFSET 0 1"),
      "walk.bvh:4:11: expected a number for z of the OFFSET of joint 'Hips', found the end of "
      "the file");
  EXPECT_EQ(rejection("HIERARCHY\nROOT Hips\n{\nOFFSET 0 1 2\nCHANNELS 1 Xrotation\n"),
            "walk.bvh:6:1: expected 'JOINT', 'End Site' or '}' in joint 'Hips', found the end of "
            "the file");
}

TEST(BvhErrors, missing_parts_of_a_joint) {
  Pieces pieces;
  pieces.name = "ROOT\n{\n";
  EXPECT_EQ(pieces.rejection(),
            "walk.bvh:2:5: expected a name after 'ROOT', found the end of the line");
  pieces = {};
  pieces.name = "ROOT Hips\n";
  EXPECT_EQ(pieces.rejection(), "walk.bvh:3:3: expected '{' of joint 'Hips', found 'OFFSET'");
  pieces = {};
  pieces.offset = "";
  EXPECT_EQ(pieces.rejection(),
            "walk.bvh:4:3: expected 'OFFSET' of joint 'Hips', found 'CHANNELS'");
  pieces = {};
  pieces.channels = "";
  EXPECT_EQ(pieces.rejection(),
            "walk.bvh:5:3: expected 'CHANNELS' of joint 'Hips' ('CHANNELS 0' where it does not "
            "move), found 'End'");
  pieces = {};
  pieces.close = "";
  EXPECT_EQ(pieces.rejection(),
            "walk.bvh:10:1: expected 'JOINT', 'End Site' or '}' in joint 'Hips', found 'MOTION'");
  pieces = {};
  pieces.close = "}\n}\n";
  EXPECT_EQ(pieces.rejection(), "walk.bvh:11:1: expected 'ROOT' or 'MOTION', found '}'");
  pieces = {};
  pieces.end = "  End Site\n  {\n  }\n";
  EXPECT_EQ(pieces.rejection(),
            "walk.bvh:8:3: expected 'OFFSET' of an End Site of joint 'Hips', found '}'");
  pieces.end = "  End Site\n  {\n    OFFSET 0 1 0\n";
  pieces.close = "";
  EXPECT_EQ(pieces.rejection(),
            "walk.bvh:9:1: expected '}' of an End Site of joint 'Hips', found 'MOTION'");
  pieces.end = "  End\n  {\n";
  EXPECT_EQ(pieces.rejection(),
            "walk.bvh:6:6: expected 'Site' after 'End', found the end of the line");
}

TEST(BvhErrors, wrong_numbers_in_the_hierarchy) {
  Pieces pieces;
  pieces.offset = "  OFFSET 0 1,5 0\n";
  EXPECT_EQ(pieces.rejection(),
            "walk.bvh:4:12: expected a number for y of the OFFSET of joint 'Hips', found '1,5'; "
            "write decimals with a point and separate numbers by spaces");
  pieces.offset = "  OFFSET 1e10 1 0\n";
  EXPECT_EQ(pieces.rejection(),
            "walk.bvh:4:10: expected a number between -1e9 and 1e9 for x of the OFFSET of joint "
            "'Hips', found '1e10'");
  pieces.offset = "  OFFSET 1 1\n";
  EXPECT_EQ(
      pieces.rejection(),
      "walk.bvh:4:13: expected a number for z of the OFFSET of joint 'Hips', found the end of "
      "the line");
}

TEST(BvhErrors, wrong_channels) {
  Pieces pieces;
  pieces.channels = "  CHANNELS\n";
  EXPECT_EQ(pieces.rejection(),
            "walk.bvh:5:11: expected a number of channels from 0 to 6 for joint 'Hips', found the "
            "end of the line");
  pieces.channels = "  CHANNELS 3 Xrotation Wrotation Zposition\n";
  EXPECT_EQ(pieces.rejection(),
            "walk.bvh:5:24: expected Xposition, Yposition, Zposition, Xrotation, Yrotation or "
            "Zrotation as channel 2 of 3 of joint 'Hips', found 'Wrotation'");
  pieces.channels = "  CHANNELS 3 Xrotation Yrotation\n";
  EXPECT_EQ(pieces.rejection(),
            "walk.bvh:6:3: expected Xposition, Yposition, Zposition, Xrotation, Yrotation or "
            "Zrotation as channel 3 of 3 of joint 'Hips', found 'End'");
  pieces.channels = "  CHANNELS 1 Xrotation Yrotation\n";
  EXPECT_EQ(pieces.rejection(),
            "walk.bvh:5:24: expected no more than the 1 channel that joint 'Hips' announces, found "
            "'Yrotation'");
  pieces.channels = "  CHANNELS 3 Xrotation Yrotation Xrotation\n";
  EXPECT_EQ(pieces.rejection(),
            "walk.bvh:5:34: expected a channel that the joint does not have yet as channel 3 of 3 "
            "of joint 'Hips', found 'Xrotation'");
  pieces.channels = "  CHANNELS 7 Xrotation\n";
  EXPECT_EQ(pieces.rejection(),
            "walk.bvh:5:12: expected a number of channels from 0 to 6 for joint 'Hips', found '7'");
  pieces.channels = "  CHANNELS Xrotation\n";
  EXPECT_EQ(pieces.rejection(),
            "walk.bvh:5:12: expected a number of channels from 0 to 6 for joint 'Hips', found "
            "'Xrotation'");
  pieces.channels = "  CHANNELS 0\n";
  EXPECT_EQ(pieces.rejection(),
            "walk.bvh:11:7: expected a joint with channels before the motion, found the end of the "
            "line");
}

TEST(BvhErrors, too_many_joints_and_too_deep_ones) {
  const std::string joint = "JOINT a\n{\nOFFSET 0 0 0\nCHANNELS 1 Xrotation\n";
  std::string deep = "HIERARCHY\n", many = deep;
  for (int i = 0; i <= kBvhMaxDepth; ++i) deep += joint;
  for (int i = 0; i <= kBvhMaxJoints; ++i) many += joint + "}\n";
  EXPECT_EQ(rejection(deep),
            "walk.bvh:4002:1: expected joints nested at most 1000 deep, found 'JOINT'");
  EXPECT_EQ(rejection(many), "walk.bvh:50002:1: expected at most 10000 joints, found 'JOINT'");
}

TEST(BvhErrors, a_motion_without_its_head) {
  Pieces pieces;
  pieces.name = pieces.offset = pieces.channels = pieces.end = pieces.close = "";
  EXPECT_EQ(pieces.rejection(), "walk.bvh:2:1: expected 'ROOT', found 'MOTION'");
  pieces = {};
  pieces.motion = "";
  EXPECT_EQ(pieces.rejection(), "walk.bvh:11:1: expected 'ROOT' or 'MOTION', found 'Frames:'");
  pieces = {};
  pieces.count = "";
  EXPECT_EQ(pieces.rejection(), "walk.bvh:12:1: expected 'Frames:' after 'MOTION', found 'Frame'");
  pieces = {};
  pieces.time = "";
  EXPECT_EQ(pieces.rejection(),
            "walk.bvh:13:1: expected 'Frame Time:' after 'Frames:', found '1'; give its "
            "rate");
}

TEST(BvhErrors, wrong_frame_counts) {
  Pieces pieces;
  for (const char* count : {"-2", "2.0", "two"}) {
    pieces.count = std::string("Frames: ") + count + "\n";
    EXPECT_EQ(pieces.rejection(),
              std::string("walk.bvh:12:9: expected a number of frames, found '") + count + "'");
  }
  pieces.count = "Frames: 0\n";
  pieces.frames = "";
  EXPECT_EQ(pieces.rejection(),
            "walk.bvh:14:1: expected a frame at least, found the end of the file");
}

TEST(BvhErrors, still_joints_may_not_fill_the_memory) {
  // 9,999 joints without a channel and one with: two bytes of file would be 280 kB of poses.
  std::string text = "HIERARCHY\nROOT a\n{\nOFFSET 0 0 0\nCHANNELS 1 Xrotation\n}\n";
  for (int i = 1; i < kBvhMaxJoints; ++i) text += "ROOT a\n{\nOFFSET 0 0 0\nCHANNELS 0\n}\n";
  text += "MOTION\nFrames: 1000\nFrame Time: 1\n";
  for (int i = 0; i < 1000; ++i) text += "1\n";
  EXPECT_EQ(
      rejection(text),
      "walk.bvh:50145:1: expected at most 140 frames for a skeleton of 10000 joints in a file "
      "of 352054 bytes, found '1'");
  EXPECT_EQ(
      rejection(replaced(text, "Frames: 1000", "Frames: 1")),
      "walk.bvh:50145:1: expected at most 140 frames for a skeleton of 10000 joints in a file "
      "of 352051 bytes, found '1'");
}

TEST(BvhErrors, wrong_frame_times) {
  Pieces pieces;
  for (const char* time : {"0", "-0.04", "1e-9"}) {
    pieces.time = std::string("Frame Time: ") + time + "\n";
    EXPECT_EQ(pieces.rejection(),
              std::string("walk.bvh:13:13: expected a frame time of a millionth of "
                          "a second or more, found '") +
                  time + "'; give its rate");
  }
  pieces.time = "Frame Time: nan\n";
  EXPECT_EQ(pieces.rejection(),
            "walk.bvh:13:13: expected a number for the frame time, found 'nan'; give its rate");
  pieces.time = "Frame Time: 0.04 1 2 3\n";
  EXPECT_EQ(pieces.rejection(),
            "walk.bvh:13:18: expected the end of the line after the frame time, found '1'; "
            "give its rate");
}

TEST(BvhErrors, wrong_numbers_in_a_frame) {
  Pieces pieces;
  for (const char* wrong :
       {"abc", "nan", "-inf", "inf", "1.#QNAN", "0x10", "1e", "--1", "+-1", "5}"}) {
    pieces.frames = "1 2 3\n4\t" + std::string(wrong) + " 6\n";
    EXPECT_EQ(
        pieces.rejection(),
        std::string("walk.bvh:15:3: expected a number for channel 2 of joint 'Hips', found '") +
            wrong + "'");
  }
  for (const char* wrong : {"1e400", "-1.1e9", "12345678901"}) {
    pieces.frames = "1 2 3\n4 5 " + std::string(wrong) + "\n";
    EXPECT_EQ(pieces.rejection(),
              std::string("walk.bvh:15:5: expected a number between -1e9 and 1e9 "
                          "for channel 3 of joint 'Hips', found '") +
                  wrong + "'");
  }
}

TEST(BvhErrors, the_joint_of_a_wrong_number_is_named) {
  EXPECT_EQ(rejection(replaced(read_fixture("plain.bvh"), "89.000000", "eighty")),
            "walk.bvh:29:95: expected a number for channel 2 of joint 'Spine', found 'eighty'");
  EXPECT_EQ(rejection(replaced(read_fixture("odd.bvh"), "-3 10", "-3 ten")),
            "walk.bvh:37:9: expected a number for channel 1 of joint 'Hand', found 'ten'");
}

TEST(BvhErrors, a_line_is_a_frame) {
  Pieces pieces;
  pieces.frames = "1 2\n3 4 5 6\n";
  EXPECT_EQ(pieces.rejection(),
            "walk.bvh:14:4: expected a number for channel 3 of joint 'Hips', found the end of the "
            "line");
  pieces.frames = "1 2 3 4 5 6\n";
  EXPECT_EQ(
      pieces.rejection(),
      "walk.bvh:14:7: expected the end of the line after the 3 numbers of a frame, found '4'");
}

TEST(BvhErrors, a_truncated_motion) {
  Pieces pieces;
  pieces.frames = "1 2";
  EXPECT_EQ(pieces.rejection(),
            "walk.bvh:14:4: expected a number for channel 3 of joint 'Hips', found the end of the "
            "file");
  pieces.frames = "1 2\n4 5 6\n";
  EXPECT_EQ(pieces.rejection(),
            "walk.bvh:14:4: expected a number for channel 3 of joint 'Hips', found the end of the "
            "line");
  pieces.count = "Frames: 1\n";
  pieces.frames = "";
  EXPECT_EQ(pieces.rejection(),
            "walk.bvh:14:1: expected a frame at least, found the end of the file");
}

TEST(BvhErrors, text_after_the_last_frame) {
  Pieces pieces;
  pieces.frames += "the end\n";
  EXPECT_EQ(pieces.rejection(),
            "walk.bvh:16:1: expected a frame or the end of the file after the 2 frames announced, "
            "found 'the'");
}

TEST(BvhErrors, lines_are_counted_at_every_kind_of_line_end) {
  Pieces pieces;
  pieces.head = "\xef\xbb\xbfHIERARCHY\r\n\r";
  pieces.channels = "  CHANNELS x\r\n";
  EXPECT_EQ(pieces.rejection(),
            "walk.bvh:6:12: expected a number of channels from 0 to 6 for joint 'Hips', found 'x'");
  EXPECT_EQ(rejection("\xef\xbb\xbfHI"), "walk.bvh:1:1: expected 'HIERARCHY', found 'HI'");
}

TEST(BvhErrors, names_are_quoted_as_they_are) {
  Pieces pieces;
  pieces.name = "ROOT \xe8\x85\xb0 \x01\xff\n{\n";
  pieces.offset = "";
  EXPECT_EQ(pieces.rejection(),
            "walk.bvh:4:3: expected 'OFFSET' of joint '\xe8\x85\xb0 \\x01\\xff', found 'CHANNELS'");
}

}  // namespace
}  // namespace panache
