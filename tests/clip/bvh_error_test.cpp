#include <array>
#include <utility>

#include "fixtures.h"

namespace panache {
namespace {

// A file of one joint, in pieces to be spoilt one by one.
enum Piece { kHead, kName, kOffset, kChannels, kEnd, kClose, kMotion, kCount, kTime, kFrames };
const std::array<std::string, 10> kWhole = {
    "HIERARCHY\n",                                   // Line 1.
    "ROOT Hips\n{\n",                                // Lines 2 and 3.
    "  OFFSET 0 1 0\n",                              // Line 4.
    "  CHANNELS 3 Xrotation Yrotation Zposition\n",  // Line 5.
    "  End Site\n  {\n    OFFSET 0 1 0\n  }\n",      // Lines 6 to 9.
    "}\n",                                           // Line 10.
    "MOTION\n",                                      // Line 11.
    "Frames: 2\n",                                   // Line 12.
    "Frame Time: 0.04\n",                            // Line 13.
    "1 2 3\n4 5 6\n",                                // Lines 14 and 15.
};

// The message about the file with other pieces, without the file's name.
std::string message(const std::vector<std::pair<Piece, std::string>>& spoilt) {
  std::array<std::string, 10> pieces = kWhole;
  for (const auto& [piece, text] : spoilt) pieces[piece] = text;
  std::string text;
  for (const std::string& piece : pieces) text += piece;
  const std::string out = rejection(text);
  return out.starts_with("walk.bvh:") ? out.substr(9) : out;
}

TEST(BvhErrors, the_pieces_together_are_a_file) { EXPECT_EQ(message({}), "(accepted)"); }

TEST(BvhErrors, a_file_that_is_no_bvh_or_ends_too_soon) {
  const std::pair<std::string, std::string> cases[] = {
      {"", "1:1: expected 'HIERARCHY', found the end of the file"},
      {" \n\n", "3:1: expected 'HIERARCHY', found the end of the file"},
      {std::string("\x89PNG\r\n\x1a\n\0\0", 10), "1:1: expected 'HIERARCHY', found '\\x89PNG'"},
      {std::string("\0\0\0\0", 4), "1:1: expected 'HIERARCHY', found '\\x00\\x00\\x00\\x00'"},
      {std::string(1000, 'x'),
       "1:1: expected 'HIERARCHY', found '" + std::string(40, 'x') + "...'"},
      {"\xef\xbb\xbfHI", "1:1: expected 'HIERARCHY', found 'HI'"},
      {"HIERARCHY", "1:10: expected 'ROOT', found the end of the file"},
      {"HIERARCHY\nROOT Hips\n{\n  OFF", "4:3: expected 'OFFSET' of joint 'Hips', found 'OFF'"},
      {"HIERARCHY\nROOT Hips\n{\nOFFSET 0 1",
       "4:11: expected a number for z of the OFFSET of joint 'Hips', found the end of the file"},
      {"HIERARCHY\nROOT Hips\n{\nOFFSET 0 1 2\nCHANNELS 1 Xrotation\n",
       "6:1: expected 'JOINT', 'End Site' or '}' in joint 'Hips', found the end of the file"},
  };
  for (const auto& [text, expected] : cases) EXPECT_EQ(rejection(text), "walk.bvh:" + expected);
}

TEST(BvhErrors, every_piece_that_is_missing_or_wrong_has_its_place_and_message) {
  const std::string channel =
      "expected Xposition, Yposition, Zposition, Xrotation, Yrotation or Zrotation as channel ";
  const struct {
    std::vector<std::pair<Piece, std::string>> spoilt;
    std::string message;
  } cases[] = {
      // Parts of a joint that are missing.
      {{{kName, "ROOT\n{\n"}}, "2:5: expected a name after 'ROOT', found the end of the line"},
      {{{kName, "ROOT Hips\n"}}, "3:3: expected '{' of joint 'Hips', found 'OFFSET'"},
      {{{kOffset, ""}}, "4:3: expected 'OFFSET' of joint 'Hips', found 'CHANNELS'"},
      {{{kChannels, ""}},
       "5:3: expected 'CHANNELS' of joint 'Hips' ('CHANNELS 0' where it does not move), found "
       "'End'"},
      {{{kClose, ""}}, "10:1: expected 'JOINT', 'End Site' or '}' in joint 'Hips', found 'MOTION'"},
      {{{kClose, "}\n}\n"}}, "11:1: expected 'ROOT' or 'MOTION', found '}'"},
      {{{kEnd, "  End Site\n  {\n  }\n"}},
       "8:3: expected 'OFFSET' of an End Site of joint 'Hips', found '}'"},
      {{{kEnd, "  End Site\n  {\n    OFFSET 0 1 0\n"}, {kClose, ""}},
       "9:1: expected '}' of an End Site of joint 'Hips', found 'MOTION'"},
      {{{kEnd, "  End\n  {\n"}}, "6:6: expected 'Site' after 'End', found the end of the line"},
      // Numbers of the hierarchy.
      {{{kOffset, "  OFFSET 0 1,5 0\n"}},
       "4:12: expected a number for y of the OFFSET of joint 'Hips', found '1,5'; write decimals "
       "with a point and separate numbers by spaces"},
      {{{kOffset, "  OFFSET 1e10 1 0\n"}},
       "4:10: expected a number between -1e9 and 1e9 for x of the OFFSET of joint 'Hips', found "
       "'1e10'"},
      {{{kOffset, "  OFFSET 1 1\n"}},
       "4:13: expected a number for z of the OFFSET of joint 'Hips', found the end of the line"},
      // Channels.
      {{{kChannels, "  CHANNELS\n"}},
       "5:11: expected a number of channels from 0 to 6 for joint 'Hips', found the end of the "
       "line"},
      {{{kChannels, "  CHANNELS 3 Xrotation Wrotation Zposition\n"}},
       "5:24: " + channel + "2 of 3 of joint 'Hips', found 'Wrotation'"},
      {{{kChannels, "  CHANNELS 3 Xrotation Yrotation\n"}},
       "6:3: " + channel + "3 of 3 of joint 'Hips', found 'End'"},
      {{{kChannels, "  CHANNELS 1 Xrotation Yrotation\n"}},
       "5:24: expected no more than the 1 channel that joint 'Hips' announces, found 'Yrotation'"},
      {{{kChannels, "  CHANNELS 3 Xrotation Yrotation Xrotation\n"}},
       "5:34: expected a channel that the joint does not have yet as channel 3 of 3 of joint "
       "'Hips', found 'Xrotation'"},
      {{{kChannels, "  CHANNELS 7 Xrotation\n"}},
       "5:12: expected a number of channels from 0 to 6 for joint 'Hips', found '7'"},
      {{{kChannels, "  CHANNELS Xrotation\n"}},
       "5:12: expected a number of channels from 0 to 6 for joint 'Hips', found 'Xrotation'"},
      {{{kChannels, "  CHANNELS 0\n"}},
       "11:7: expected a joint with channels before the motion, found the end of the line"},
      // The head of the motion.
      {{{kName, ""}, {kOffset, ""}, {kChannels, ""}, {kEnd, ""}, {kClose, ""}},
       "2:1: expected 'ROOT', found 'MOTION'"},
      {{{kMotion, ""}}, "11:1: expected 'ROOT' or 'MOTION', found 'Frames:'"},
      {{{kCount, ""}}, "12:1: expected 'Frames:' after 'MOTION', found 'Frame'"},
      {{{kTime, ""}}, "13:1: expected 'Frame Time:' after 'Frames:', found '1'; give its rate"},
      {{{kCount, "Frames: 0\n"}, {kFrames, ""}},
       "14:1: expected a frame at least, found the end of the file"},
      {{{kTime, "Frame Time: nan\n"}},
       "13:13: expected a number for the frame time, found 'nan'; give its rate"},
      {{{kTime, "Frame Time: 0.04 1 2 3\n"}},
       "13:18: expected the end of the line after the frame time, found '1'; give its rate"},
      // A line is a frame.
      {{{kFrames, "1 2\n3 4 5 6\n"}},
       "14:4: expected a number for channel 3 of joint 'Hips', found the end of the line"},
      {{{kFrames, "1 2 3 4 5 6\n"}},
       "14:7: expected the end of the line after the 3 numbers of a frame, found '4'"},
      {{{kFrames, "1 2"}},
       "14:4: expected a number for channel 3 of joint 'Hips', found the end of the file"},
      {{{kCount, "Frames: 1\n"}, {kFrames, ""}},
       "14:1: expected a frame at least, found the end of the file"},
      {{{kFrames, "1 2 3\n4 5 6\nthe end\n"}},
       "16:1: expected a frame or the end of the file after the 2 frames announced, found 'the'"},
      // Lines are counted at every kind of line end, and names are quoted as they are.
      {{{kHead, "\xef\xbb\xbfHIERARCHY\r\n\r"}, {kChannels, "  CHANNELS x\r\n"}},
       "6:12: expected a number of channels from 0 to 6 for joint 'Hips', found 'x'"},
      {{{kName, "ROOT \xe8\x85\xb0 \x01\xff\n{\n"}, {kOffset, ""}},
       "4:3: expected 'OFFSET' of joint '\xe8\x85\xb0 \\x01\\xff', found 'CHANNELS'"},
  };
  for (const auto& [spoilt, expected] : cases) EXPECT_EQ(message(spoilt), expected);
}

TEST(BvhErrors, numbers_that_are_none) {
  for (const std::string count : {"-2", "2.0", "two"}) {
    EXPECT_EQ(message({{kCount, "Frames: " + count + "\n"}}),
              "12:9: expected a number of frames, found '" + count + "'");
  }
  for (const std::string time : {"0", "-0.04", "1e-9"}) {
    EXPECT_EQ(message({{kTime, "Frame Time: " + time + "\n"}}),
              "13:13: expected a frame time of a millionth of a second or more, found '" + time +
                  "'; give its rate");
  }
  for (const std::string wrong :
       {"abc", "nan", "-inf", "inf", "1.#QNAN", "0x10", "1e", "--1", "+-1", "5}"}) {
    EXPECT_EQ(message({{kFrames, "1 2 3\n4\t" + wrong + " 6\n"}}),
              "15:3: expected a number for channel 2 of joint 'Hips', found '" + wrong + "'");
  }
  for (const std::string wrong : {"1e400", "-1.1e9", "12345678901"}) {
    EXPECT_EQ(
        message({{kFrames, "1 2 3\n4 5 " + wrong + "\n"}}),
        "15:5: expected a number between -1e9 and 1e9 for channel 3 of joint 'Hips', found '" +
            wrong + "'");
  }
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

TEST(BvhErrors, still_joints_may_not_fill_the_memory) {
  // 9,999 joints without a channel and one with: two bytes of file would be 280 kB of poses.
  std::string text = "HIERARCHY\nROOT a\n{\nOFFSET 0 0 0\nCHANNELS 1 Xrotation\n}\n";
  for (int i = 1; i < kBvhMaxJoints; ++i) text += "ROOT a\n{\nOFFSET 0 0 0\nCHANNELS 0\n}\n";
  text += "MOTION\nFrames: 1000\nFrame Time: 1\n";
  for (int i = 0; i < 1000; ++i) text += "1\n";
  const std::string start =
      "walk.bvh:50145:1: expected at most 140 frames for a skeleton of 10000 joints in a file of ";
  EXPECT_EQ(rejection(text), start + "352054 bytes, found '1'");
  EXPECT_EQ(rejection(replaced(text, "Frames: 1000", "Frames: 1")),
            start + "352051 bytes, found '1'");
}

TEST(BvhErrors, the_joint_of_a_wrong_number_is_named) {
  EXPECT_EQ(rejection(replaced(read_fixture("plain.bvh"), "89.000000", "eighty")),
            "walk.bvh:29:95: expected a number for channel 2 of joint 'Spine', found 'eighty'");
  EXPECT_EQ(rejection(replaced(read_fixture("odd.bvh"), "-3 10", "-3 ten")),
            "walk.bvh:37:9: expected a number for channel 1 of joint 'Hand', found 'ten'");
}

}  // namespace
}  // namespace panache
